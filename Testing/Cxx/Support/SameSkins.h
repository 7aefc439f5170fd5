/**
 * Compares the bytes of two skins.
 */
#ifndef SameSkins_h
#define SameSkins_h

#include <gtest/gtest.h>

#include <string>

namespace activesurface
{

/** Success if the bytes of two skins, or of their arrays, are equal. Failure if both are empty: two
 * missing skins are no proof. */
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
