// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "asterism/core/options.hpp"

// Every key of a cell file, in one place: the reader holds a file to these forms, and `asterism schema`
// prints them.

namespace asterism {

enum class Holds { Number, Whole, Flag, Text, Word, Numbers, Table, Tables };

struct Form;

/// A key of a table and what may stand there.
struct Key {
  std::string name;
  Holds holds = Holds::Number;
  std::string help;
  bool needed = false;
  std::vector<std::string> words = {};  // of a Word
  std::size_t count = 0;                // of Numbers; 0 = as many as there are
  std::vector<Form> forms = {};         // of a Table or Tables: each is one of these
};

/// What a table may be: its keys, and the options of a struct that describes itself.
struct Form {
  std::string of;  // in complaints: "a motion"
  std::vector<Key> keys;
  std::function<void(OptionVisitor&)> options = {};  // at their defaults

  [[nodiscard]] std::vector<std::string> names() const;
};

/// The keys of both.
[[nodiscard]] Form joined(Form first, const Form& second);
/// Of several forms that a word tells apart: the words of that key.
[[nodiscard]] std::vector<std::string> words_of(const std::vector<Form>& forms, const std::string& key);
/// The form that holds `word` in that key.
[[nodiscard]] const Form& form_of(const std::vector<Form>& forms, const std::string& key,
                                  const std::string& word);

namespace forms {

/// The whole file.
[[nodiscard]] const Form& cell();

[[nodiscard]] const Form& rig_file();
[[nodiscard]] const Form& lenses();
[[nodiscard]] const Form& camera_pair();
[[nodiscard]] const Form& lens();
[[nodiscard]] const Form& volume_preset();
[[nodiscard]] const Form& volume();
[[nodiscard]] const Form& pose();
[[nodiscard]] const Form& seen_pose();
[[nodiscard]] const Form& pose_in_body();
[[nodiscard]] const Form& body();
[[nodiscard]] const Form& target();
[[nodiscard]] const Form& published();
[[nodiscard]] const std::vector<Form>& motions();
[[nodiscard]] const Form& turning();
[[nodiscard]] const Form& shifting();
[[nodiscard]] const Form& key_pose();
[[nodiscard]] const std::vector<Form>& shapes();
/// Shapes together with the keys of what has a shape.
[[nodiscard]] std::vector<Form> shaped(const Form& with);
[[nodiscard]] const Form& obstacle();
[[nodiscard]] const Form& keep_out();
[[nodiscard]] const Form& platform();
[[nodiscard]] const Form& stroke();
[[nodiscard]] const Form& read_out();
[[nodiscard]] const Form& workpiece_by_mesh();
[[nodiscard]] const Form& workpiece_by_casing();
[[nodiscard]] const Form& fixture();
[[nodiscard]] const Form& fixture_by_mesh();
[[nodiscard]] const Form& fixture_by_casing();
[[nodiscard]] const Form& casing();
[[nodiscard]] const Form& scanner();
[[nodiscard]] const Form& scan_pass();
[[nodiscard]] const Form& scan();
[[nodiscard]] const Form& scan_region();
[[nodiscard]] const Form& robot();
[[nodiscard]] const Form& robot_joint();
[[nodiscard]] const Form& robot_link();
[[nodiscard]] const Form& noise();
[[nodiscard]] const Form& fault();
[[nodiscard]] const Form& lamp();
[[nodiscard]] const Form& verify();
[[nodiscard]] const Form& point();
[[nodiscard]] const Form& layout();
[[nodiscard]] const std::vector<Form>& patches();
[[nodiscard]] const Form& sensor();
[[nodiscard]] const Form& light();
[[nodiscard]] const Form& timing();

}  // namespace forms

}  // namespace asterism
