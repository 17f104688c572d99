// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_forms.hpp"

#include <algorithm>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

class NameLister : public OptionVisitor {
 public:
  explicit NameLister(std::vector<std::string>& names) : names_(names) {}
  void number(std::string_view name, double&, Limits, std::string_view) override { add(name); }
  void integer(std::string_view name, int&, Limits, std::string_view) override { add(name); }
  void flag(std::string_view name, bool&, std::string_view) override { add(name); }
  void text(std::string_view name, std::string&, std::string_view) override { add(name); }
  void choice(std::string_view name, int&, const std::vector<std::string>&, std::string_view) override {
    add(name);
  }

 private:
  void add(std::string_view name) { names_.emplace_back(name); }
  std::vector<std::string>& names_;
};

}  // namespace

std::vector<std::string> Form::names() const {
  std::vector<std::string> all;
  for (const Key& key : keys) all.push_back(key.name);
  NameLister lister(all);
  if (options) options(lister);
  return all;
}

Form joined(Form first, const Form& second) {
  require(!first.options || !second.options, "a table has the options of one struct");
  first.keys.insert(first.keys.end(), second.keys.begin(), second.keys.end());
  if (second.options) first.options = second.options;
  return first;
}

std::vector<std::string> words_of(const std::vector<Form>& forms, const std::string& key) {
  std::vector<std::string> words;
  for (const Form& form : forms) {
    for (const Key& one : form.keys) {
      if (one.name == key) words.push_back(one.words.at(0));
    }
  }
  return words;
}

const Form& form_of(const std::vector<Form>& forms, const std::string& key, const std::string& word) {
  const std::vector<std::string> words = words_of(forms, key);
  const auto found = std::find(words.begin(), words.end(), word);
  require(found != words.end() && words.size() == forms.size(), "the word was held to those of the forms");
  return forms[static_cast<std::size_t>(found - words.begin())];
}

}  // namespace asterism
