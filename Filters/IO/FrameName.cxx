#include "FrameName.h"

#include <algorithm>
#include <filesystem>
#include <regex>

namespace activesurface
{

namespace
{

constexpr std::size_t MostDigits = 32;

std::string Pad(int number, std::size_t digits)
{
  const std::string text = std::to_string(number);
  digits = std::min(digits, MostDigits);
  return std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

}

std::string MakeFrameName(const std::string& pattern, int number, bool always)
{
  const std::size_t last = pattern.find_last_of('#');
  const std::size_t folder = pattern.find_last_of('/');
  if (last != std::string::npos && (folder == std::string::npos || folder < last))
  {
    const std::size_t before = pattern.find_last_not_of('#', last);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    return pattern.substr(0, first) + Pad(number, last + 1 - first) + pattern.substr(last + 1);
  }
  static const std::regex printed("%(0([0-9]{1,2}))?d");
  std::smatch found;
  if (std::regex_search(pattern, found, printed))
  {
    const std::size_t digits = found[2].matched ? std::stoul(found[2]) : 1;
    return found.prefix().str() + Pad(number, digits) + found.suffix().str();
  }
  if (!always)
  {
    return pattern;
  }
  const std::filesystem::path path(pattern);
  std::filesystem::path numbered = path;
  numbered.replace_filename(
    path.stem().string() + "." + Pad(number, 4) + path.extension().string());
  return numbered.string();
}

}
