# SPDX-License-Identifier: Apache-2.0
# asterism_room(NAME USES room… LIBRARIES target… PRIVATE_LIBRARIES target…)
# One folder of src/asterism is one static library; its *_test.cpp become one test program beside it.

add_library(asterism_flags INTERFACE)
target_compile_features(asterism_flags INTERFACE cxx_std_20)
# No contraction to fused multiply-add: the same bits on every machine is a promise.
# -Wno-psabi: 32-byte vectors are passed between inlined functions only.
target_compile_options(asterism_flags INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi
  $<$<BOOL:${ASTERISM_WERROR}>:-Werror>)
if(ASTERISM_SANITIZE)
  target_compile_options(asterism_flags INTERFACE -fsanitize=${ASTERISM_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all -g1)
  target_link_options(asterism_flags INTERFACE -fsanitize=${ASTERISM_SANITIZE})
  target_compile_definitions(asterism_flags INTERFACE ASTERISM_NO_CLONES)
endif()

# What nearly every file takes, compiled once for libraries and once more for tests. A file still includes what
# it uses: with a compiler cache nothing is compiled ahead.
function(asterism_compile_ahead target)
  if(CCACHE)
    return()
  endif()
  cmake_parse_arguments(AHEAD "TESTS" "" "" ${ARGN})
  # GCC 12 takes what it inlines from a precompiled header for ours, and warns of std::string's own copying.
  target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
    -Wno-stringop-overread -Wno-maybe-uninitialized)
  set(ahead asterism_ahead)
  set(headers <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <tl/expected.hpp> <algorithm> <array> <cmath>
    <filesystem> <functional> <map> <memory> <optional> <span> <string> <variant> <vector>)
  set(libraries Eigen3::Eigen fmt::fmt)
  if(AHEAD_TESTS)
    set(ahead asterism_tests_ahead)
    list(APPEND headers <gtest/gtest.h>)
    list(APPEND libraries GTest::gtest)
  endif()
  if(NOT TARGET ${ahead})
    file(WRITE ${PROJECT_BINARY_DIR}/ahead/${ahead}.cpp "")
    add_library(${ahead} OBJECT ${PROJECT_BINARY_DIR}/ahead/${ahead}.cpp)
    target_link_libraries(${ahead} PRIVATE asterism_flags ${libraries})
    target_precompile_headers(${ahead} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${ahead})
endfunction()

function(asterism_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ROOM_USES PREPEND asterism_)

  if(sources)
    add_library(asterism_${name} STATIC ${sources})
    target_include_directories(asterism_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(asterism_${name} PUBLIC Eigen3::Eigen fmt::fmt ${ROOM_USES} ${ROOM_LIBRARIES}
      PRIVATE asterism_flags ${ROOM_PRIVATE_LIBRARIES})
    asterism_compile_ahead(asterism_${name})
  else()
    add_library(asterism_${name} INTERFACE)
    target_include_directories(asterism_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(asterism_${name} INTERFACE Eigen3::Eigen fmt::fmt ${ROOM_USES} ${ROOM_LIBRARIES})
  endif()

  if(ASTERISM_TESTS AND tests)
    add_executable(asterism_${name}_test ${tests})
    target_link_libraries(asterism_${name}_test PRIVATE asterism_${name} asterism_flags
      ${ROOM_PRIVATE_LIBRARIES} GTest::gtest_main)
    asterism_compile_ahead(asterism_${name}_test TESTS)
    gtest_discover_tests(asterism_${name}_test TEST_PREFIX "${name}." PROPERTIES TIMEOUT 300
      DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
