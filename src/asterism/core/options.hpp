// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace asterism {

/// What a numeric option may be.
struct Limits {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// Sees each field of an options struct once. A step writes
///
///   void describe(DetectionOptions& options, OptionVisitor& visit) {
///     visit.number("min_diameter_px", options.min_diameter_px, {2, 1000}, "smallest disc searched for");
///   }
///
/// and from that one list come the TOML reader, the command line, the JSON echo and the checks.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  virtual void number(std::string_view name, double& value, Limits limits, std::string_view help) = 0;
  virtual void integer(std::string_view name, int& value, Limits limits, std::string_view help) = 0;
  virtual void flag(std::string_view name, bool& value, std::string_view help) = 0;
  virtual void text(std::string_view name, std::string& value, std::string_view help) = 0;
  /// One word of `words`; `index` is its place.
  virtual void choice(std::string_view name, int& index, const std::vector<std::string>& words,
                      std::string_view help) = 0;

  /// An enum whose values count up from zero in the order of `words`.
  template <class Enum>
  void choice_of(std::string_view name, Enum& value, const std::vector<std::string>& words,
                 std::string_view help) {
    int index = static_cast<int>(value);
    choice(name, index, words, help);
    value = static_cast<Enum>(index);
  }
};

/// Shows the options of a part of a whole under `section.`: the tracker's detection options as
/// `detection.min_diameter_px`.
class SectionVisitor : public OptionVisitor {
 public:
  SectionVisitor(std::string_view section, OptionVisitor& whole) : section_(section), whole_(whole) {}
  void number(std::string_view name, double& value, Limits limits, std::string_view help) override;
  void integer(std::string_view name, int& value, Limits limits, std::string_view help) override;
  void flag(std::string_view name, bool& value, std::string_view help) override;
  void text(std::string_view name, std::string& value, std::string_view help) override;
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view help) override;

 private:
  [[nodiscard]] std::string full(std::string_view name) const;
  std::string section_;
  OptionVisitor& whole_;
};

/// Of `known`, the name most like `wrong` (edit distance); empty when none is near.
[[nodiscard]] std::string nearest_name(std::string_view wrong, const std::vector<std::string>& known);

/// "`max_angel` is no option of layout; did you mean `max_angle`?"
[[nodiscard]] std::string unknown_name_message(std::string_view wrong, std::string_view of,
                                               const std::vector<std::string>& known);

/// Throws InputError when a number is not finite or outside its limits, a choice is none of its words.
void check_number(std::string_view name, double value, Limits limits);

/// Holds each number it is shown to the limits its describe() states.
class LimitsCheck : public OptionVisitor {
 public:
  void number(std::string_view name, double& value, Limits limits, std::string_view) override {
    check_number(name, value, limits);
  }
  void integer(std::string_view name, int& value, Limits limits, std::string_view) override {
    check_number(name, value, limits);
  }
  void flag(std::string_view, bool&, std::string_view) override {}
  void text(std::string_view, std::string&, std::string_view) override {}
  void choice(std::string_view, int&, const std::vector<std::string>&, std::string_view) override {}
};

}  // namespace asterism
