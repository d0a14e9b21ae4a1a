// SPDX-License-Identifier: BSD-3-Clause
#include "json_writer.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace parley::sim {
namespace {

std::string quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(c));
      text += escaped.data();
    } else {
      text += c;
    }
  }
  return text + '"';
}

std::string shown(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 400> digits{};
  std::snprintf(digits.data(), digits.size(), "%.4f", value);
  std::string text = digits.data();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

void JsonWriter::begin(const std::string& key) {
  if (depth_ > 0) {
    text_ += first_ ? "\n" : ",\n";
    text_.append(static_cast<std::size_t>(2 * depth_), ' ');
  }
  if (!key.empty()) text_ += quoted(key) + ": ";
  first_ = false;
}

void JsonWriter::open(const std::string& key, char bracket) {
  begin(key);
  text_ += bracket;
  ++depth_;
  first_ = true;
}

void JsonWriter::close(char bracket) {
  --depth_;
  if (!first_) {
    text_ += '\n';
    text_.append(static_cast<std::size_t>(2 * depth_), ' ');
  }
  text_ += bracket;
  first_ = false;
}

void JsonWriter::text(const std::string& key, const std::string& value) {
  begin(key);
  text_ += quoted(value);
}

void JsonWriter::number(const std::string& key, double value) {
  begin(key);
  text_ += shown(value);
}

void JsonWriter::number(const std::string& key, const std::optional<double>& value) {
  if (value) {
    number(key, *value);
  } else {
    null(key);
  }
}

void JsonWriter::integer(const std::string& key, std::int64_t value) {
  begin(key);
  text_ += std::to_string(value);
}

void JsonWriter::flag(const std::string& key, bool value) {
  begin(key);
  text_ += value ? "true" : "false";
}

void JsonWriter::null(const std::string& key) {
  begin(key);
  text_ += "null";
}

std::string JsonWriter::finish() {
  close('}');
  return text_ + "\n";
}

}  // namespace parley::sim
