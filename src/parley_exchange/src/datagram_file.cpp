// SPDX-License-Identifier: BSD-3-Clause
#include "datagram_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace parley {
namespace {

bool isText(const std::string& content) {
  return std::all_of(content.begin(), content.end(),
                     [](unsigned char c) { return std::isprint(c) != 0 || std::isspace(c) != 0; });
}

bool isHexadecimal(const std::string& line) {
  return !line.empty() && line.size() % 2 == 0 &&
         std::all_of(line.begin(), line.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

std::vector<Bytes> readText(const std::string& content) {
  std::vector<Bytes> datagrams;
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    line.erase(std::remove_if(line.begin(), line.end(), [](unsigned char c) { return std::isspace(c) != 0; }), line.end());
    if (!isHexadecimal(line)) continue;
    Bytes bytes;
    for (std::size_t i = 0; i < line.size(); i += 2)
      bytes.push_back(static_cast<std::uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
    datagrams.push_back(std::move(bytes));
  }
  return datagrams;
}

std::vector<Bytes> readBinary(const std::string& content, const std::string& path) {
  std::vector<Bytes> datagrams;
  const auto byteAt = [&content](std::size_t at) { return static_cast<std::uint8_t>(content[at]); };
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t length =
        at + 2 <= content.size() ? static_cast<std::size_t>(byteAt(at) * 256 + byteAt(at + 1)) : content.size();
    if (at + 2 + length > content.size()) throw std::invalid_argument(path + ": ends within a datagram");
    const auto begin = content.begin() + static_cast<std::ptrdiff_t>(at + 2);
    datagrams.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(length));
    at += 2 + length;
  }
  return datagrams;
}

}  // namespace

std::vector<Bytes> readDatagrams(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": cannot read: " + std::strerror(errno));
  const std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return isText(content) ? readText(content) : readBinary(content, path);
}

}  // namespace parley
