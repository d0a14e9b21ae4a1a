// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace parley::sim {

/// Builds an indented JSON text key by key. Numbers have four decimals at most, so that a text says what was measured
/// and not how it was added up.
class JsonWriter {
 public:
  JsonWriter() { open("", '{'); }

  void beginObject(const std::string& key = "") { open(key, '{'); }
  void beginList(const std::string& key) { open(key, '['); }
  void endObject() { close('}'); }
  void endList() { close(']'); }

  void text(const std::string& key, const std::string& value);
  void number(const std::string& key, double value);
  /// null where there is no value.
  void number(const std::string& key, const std::optional<double>& value);
  void integer(const std::string& key, std::int64_t value);
  void flag(const std::string& key, bool value);
  void null(const std::string& key);

  /// Closes the outermost object; the writer is done with.
  std::string finish();

 private:
  void open(const std::string& key, char bracket);
  void close(char bracket);
  void begin(const std::string& key);

  std::string text_;
  int depth_ = 0;
  bool first_ = true;
};

}  // namespace parley::sim
