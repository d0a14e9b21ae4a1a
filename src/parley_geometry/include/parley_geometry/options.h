// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace parley {

/// A value as it comes from a file or a parameter server.
using OptionValue = std::variant<bool, long, double, std::string>;
using OptionValues = std::map<std::string, OptionValue>;

/// What a user may know about one option.
struct OptionInfo {
  std::string name, unit, type, value, minimum, maximum, doc;
};

/// Fills an options struct from values and notes every problem: wrong type, out of range, unknown key.
/// A visitor for `visit(visitor)`; call `finish()` after visiting.
class OptionReader {
 public:
  /// `source` (a file or namespace) starts every problem's text.
  OptionReader(const OptionValues& values, std::string source);

  void number(const char* name, double& field, const char* unit, double minimum, double maximum, const char* doc);
  void integer(const char* name, int& field, const char* unit, int minimum, int maximum, const char* doc);
  void flag(const char* name, bool& field, const char* doc);
  void text(const char* name, std::string& field, const char* doc);

  /// Reports keys that no option has taken; all problems so far, empty if all is well.
  std::vector<std::string> finish();

 private:
  const OptionValue* take(const char* name);
  void problem(const char* name, const std::string& reason);

  const OptionValues& values_;
  std::string source_;
  std::set<std::string> taken_;
  std::vector<std::string> problems_;
};

/// Lists the options of a struct with their current values.
class OptionLister {
 public:
  void number(const char* name, double& field, const char* unit, double minimum, double maximum, const char* doc);
  void integer(const char* name, int& field, const char* unit, int minimum, int maximum, const char* doc);
  void flag(const char* name, bool& field, const char* doc);
  void text(const char* name, std::string& field, const char* doc);

  const std::vector<OptionInfo>& infos() const { return infos_; }

 private:
  std::vector<OptionInfo> infos_;
};

/// Loads `options` from `values`; returns all problems, in which case `options` may be half filled and must not be used.
template <class Options>
std::vector<std::string> loadOptions(Options& options, const OptionValues& values, const std::string& source) {
  OptionReader reader(values, source);
  options.visit(reader);
  return reader.finish();
}

/// Range check of options that were set in code; empty if all is well.
template <class Options>
std::vector<std::string> checkOptions(Options options, const std::string& source);

template <class Options>
std::vector<OptionInfo> listOptions(Options options) {
  OptionLister lister;
  options.visit(lister);
  return lister.infos();
}

/// A Markdown table of the options for a README.
std::string optionTable(const std::vector<OptionInfo>& infos);

/// The current values, as they would be read back.
OptionValues valuesOf(const std::vector<OptionInfo>& infos);

template <class Options>
std::vector<std::string> checkOptions(Options options, const std::string& source) {
  const OptionValues values = valuesOf(listOptions(options));
  return loadOptions(options, values, source);
}

}  // namespace parley
