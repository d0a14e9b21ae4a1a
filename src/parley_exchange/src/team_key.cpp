// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/team_key.h"

#include <sodium.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace parley {
namespace {

constexpr std::size_t kDigits = 64;         // [-]
constexpr std::streamsize kMaxFile = 4096;  // [byte]

int valueOf(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

}  // namespace

TeamKey parseTeamKey(const std::string& digits) {
  const char* const blanks = " \t\r\n";
  const std::size_t begin = digits.find_first_not_of(blanks), end = digits.find_last_not_of(blanks);
  const std::string text = begin == std::string::npos ? "" : digits.substr(begin, end - begin + 1);
  if (text.size() != kDigits) {
    throw std::invalid_argument("a team key has 64 hexadecimal digits, here are " + std::to_string(text.size()) + " characters");
  }
  TeamKey key{};
  for (std::size_t i = 0; i < kDigits; ++i) {
    const int value = valueOf(text[i]);
    if (value < 0) throw std::invalid_argument("character " + std::to_string(i + 1) + " is no hexadecimal digit");
    key[i / 2] = static_cast<std::uint8_t>((key[i / 2] << 4) | value);
  }
  return key;
}

TeamKey loadTeamKey(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": cannot read the team key: " + std::strerror(errno));
  std::string text(static_cast<std::size_t>(kMaxFile), '\0');
  file.read(text.data(), kMaxFile);
  text.resize(static_cast<std::size_t>(file.gcount()));
  try {
    return parseTeamKey(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

TeamKey simulatedTeamKey(std::uint64_t number) {
  TeamKey key{};
  crypto_generichash(key.data(), key.size(), reinterpret_cast<const unsigned char*>(&number), sizeof(number), nullptr, 0);
  return key;
}

RobotId robotIdOf(const std::string& name) {
  std::array<unsigned char, 16> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(name.data()), name.size(), nullptr, 0);
  return (RobotId{hash[0]} << 24) | (RobotId{hash[1]} << 16) | (RobotId{hash[2]} << 8) | RobotId{hash[3]};
}

}  // namespace parley
