// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/options.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace parley {
namespace {

template <class Number>
std::string format(Number number) {
  std::ostringstream out;
  out.precision(10);
  out << number;
  return out.str();
}

template <class Number>
std::string outOfRange(Number value, Number minimum, Number maximum, const char* unit) {
  return "value " + format(value) + " is not within [" + format(minimum) + ", " + format(maximum) + "] " + unit;
}

}  // namespace

OptionReader::OptionReader(const OptionValues& values, std::string source) : values_(values), source_(std::move(source)) {}

const OptionValue* OptionReader::take(const char* name) {
  taken_.insert(name);
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

void OptionReader::problem(const char* name, const std::string& reason) {
  problems_.push_back(source_ + ": " + name + ": " + reason);
}

void OptionReader::number(const char* name, double& field, const char* unit, double minimum, double maximum, const char*) {
  const OptionValue* value = take(name);
  if (value == nullptr) return;
  if (const auto* real = std::get_if<double>(value)) {
    field = *real;
  } else if (const auto* whole = std::get_if<long>(value)) {
    field = static_cast<double>(*whole);
  } else {
    return problem(name, "must be a number");
  }
  if (!std::isfinite(field) || field < minimum || field > maximum) problem(name, outOfRange(field, minimum, maximum, unit));
}

void OptionReader::integer(const char* name, int& field, const char* unit, int minimum, int maximum, const char*) {
  const OptionValue* value = take(name);
  if (value == nullptr) return;
  const auto* whole = std::get_if<long>(value);
  if (whole == nullptr) return problem(name, "must be a whole number");
  if (*whole < minimum || *whole > maximum) {
    return problem(name, outOfRange<long>(*whole, minimum, maximum, unit));
  }
  field = static_cast<int>(*whole);
}

void OptionReader::flag(const char* name, bool& field, const char*) {
  const OptionValue* value = take(name);
  if (value == nullptr) return;
  const auto* flag = std::get_if<bool>(value);
  if (flag == nullptr) return problem(name, "must be true or false");
  field = *flag;
}

void OptionReader::text(const char* name, std::string& field, const char*) {
  const OptionValue* value = take(name);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(value);
  if (text == nullptr) return problem(name, "must be text");
  field = *text;
}

std::vector<std::string> OptionReader::finish() {
  for (const auto& [name, value] : values_) {
    if (taken_.count(name) == 0) problem(name.c_str(), "unknown key");
  }
  return problems_;
}

void OptionLister::number(const char* name, double& field, const char* unit, double minimum, double maximum, const char* doc) {
  infos_.push_back({name, unit, "number", format(field), format(minimum), format(maximum), doc});
}

void OptionLister::integer(const char* name, int& field, const char* unit, int minimum, int maximum, const char* doc) {
  infos_.push_back({name, unit, "integer", format(field), format(minimum), format(maximum), doc});
}

void OptionLister::flag(const char* name, bool& field, const char* doc) {
  infos_.push_back({name, "-", "flag", field ? "true" : "false", "", "", doc});
}

void OptionLister::text(const char* name, std::string& field, const char* doc) {
  infos_.push_back({name, "-", "text", field, "", "", doc});
}

std::string optionTable(const std::vector<OptionInfo>& infos) {
  std::string table = "| option | default | unit | range | what it does |\n|---|---|---|---|---|\n";
  for (const OptionInfo& info : infos) {
    const std::string range = info.minimum.empty() ? "" : info.minimum + " .. " + info.maximum;
    table += "| `" + info.name + "` | " + info.value + " | " + info.unit + " | " + range + " | " + info.doc + " |\n";
  }
  return table;
}

OptionValues valuesOf(const std::vector<OptionInfo>& infos) {
  OptionValues values;
  for (const OptionInfo& info : infos) {
    if (info.type == "number") {
      values[info.name] = std::strtod(info.value.c_str(), nullptr);  // stod throws on subnormal numbers
    } else if (info.type == "integer") {
      values[info.name] = std::strtol(info.value.c_str(), nullptr, 10);
    } else if (info.type == "flag") {
      values[info.name] = info.value == "true";
    } else {
      values[info.name] = info.value;
    }
  }
  return values;
}

}  // namespace parley
