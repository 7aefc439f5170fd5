/**
 * Whether two skins have the same bytes, and some at all.
 */
#ifndef SameSkins_h
#define SameSkins_h

#include <gtest/gtest.h>

#include <string>

namespace activesurface
{

/** Success when the bytes of two skins, or of their arrays, are equal. Failure when both are empty:
 * two skins that failed to appear are no proof. */
inline testing::AssertionResult AreSameSkins(const std::string& first, const std::string& second)
{
  if (first != second)
  {
    return testing::AssertionFailure()
      << "other bytes: " << first.size() << " and " << second.size() << " of them";
  }
  if (first.empty())
  {
    return testing::AssertionFailure() << "both skins are empty";
  }
  return testing::AssertionSuccess() << "the same " << first.size() << " bytes";
}

}

#endif
