#include "SeriesName.h"

#include <cstdio>

namespace activesurface
{

namespace
{

// Where the name begins, after the folder.
std::string::size_type FindName(const std::string& path)
{
  const auto slash = path.find_last_of('/');
  return slash == std::string::npos ? 0 : slash + 1;
}

}

bool HasNumber(const std::string& pattern)
{
  return pattern.find('#', FindName(pattern)) != std::string::npos;
}

std::string MakeSeriesName(const std::string& pattern, int number)
{
  const auto name = FindName(pattern);
  if (!HasNumber(pattern))
  {
    const auto dot = pattern.find_last_of('.');
    const auto place = dot == std::string::npos || dot <= name ? pattern.size() : dot;
    return MakeSeriesName(pattern.substr(0, place) + ".####" + pattern.substr(place), number);
  }
  const auto last = pattern.find_last_of('#');
  const auto before = pattern.find_last_not_of('#', last);
  const auto first = before == std::string::npos ? 0 : before + 1;
  std::string digits(last - first + 24, 0);
  digits.resize(
    std::snprintf(&digits[0], digits.size(), "%0*d", static_cast<int>(last - first + 1), number));
  return pattern.substr(0, first) + digits + pattern.substr(last + 1);
}

}
