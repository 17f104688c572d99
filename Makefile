# SPDX-License-Identifier: Apache-2.0
# Thin: tools/setup installs what is missing, CMake presets do the rest.
.PHONY: build demo test bench check clean

build:
	@tools/setup run
	@cmake --preset release $(QUIET)
	@cmake --build --preset release --target asterism

demo: QUIET := >/dev/null
demo: build
	@build/bin/asterism demo --out out/demo

test:
	@tools/setup run test
	@cmake --preset dev >/dev/null
	@cmake --build --preset dev
	@cd web && npm test --silent
	@ctest --preset dev

bench:
	@tools/setup run bench
	@cmake --preset bench >/dev/null
	@cmake --build --preset bench
	@tools/bench

check:
	@tools/check

clean:
	rm -rf build out web/dist web/node_modules
