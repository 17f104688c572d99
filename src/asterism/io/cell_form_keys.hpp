// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/io/cell_forms.hpp"

// Short words for the lists of keys in cell_form_*.cpp; for those files only.

namespace asterism {

inline Key number(const char* name, const char* help) { return {name, Holds::Number, help}; }
inline Key whole(const char* name, const char* help) { return {name, Holds::Whole, help}; }
inline Key flag(const char* name, const char* help) { return {name, Holds::Flag, help}; }
inline Key text(const char* name, const char* help) { return {name, Holds::Text, help}; }
inline Key word(const char* name, std::vector<std::string> words, const char* help) {
  return {name, Holds::Word, help, false, std::move(words)};
}
/// The key that tells the forms of a table apart.
inline Key kind(const char* name, const char* value) {
  return {name, Holds::Word, "what it is", true, {value}};
}
inline Key numbers(const char* name, std::size_t count, const char* help) {
  return {name, Holds::Numbers, help, false, {}, count};
}
inline Key vector(const char* name, const char* help) { return numbers(name, 3, help); }
inline Key table(const char* name, std::vector<Form> forms, const char* help) {
  return {name, Holds::Table, help, false, {}, 0, std::move(forms)};
}
inline Key tables(const char* name, std::vector<Form> forms, const char* help) {
  return {name, Holds::Tables, help, false, {}, 0, std::move(forms)};
}
inline Key needed(Key key) {
  key.needed = true;
  return key;
}

/// The options of a struct that describes itself.
template <class Options>
std::function<void(OptionVisitor&)> options_of() {
  return [](OptionVisitor& visit) {
    Options options;
    describe(options, visit);
  };
}

}  // namespace asterism
