/**
 * Checks the type and the message of an exception.
 */
#ifndef Throws_h
#define Throws_h

#include <gtest/gtest.h>

#include <string>

/**
 * Success if action() throws an Exception whose message contains the words. An exception of any
 * other type propagates, and fails the test.
 */
template <class Exception, class Action>
testing::AssertionResult Throws(Action action, const std::string& words)
{
  try
  {
    action();
  }
  catch (const Exception& error)
  {
    const std::string message = error.what();
    if (message.find(words) != std::string::npos)
    {
      return testing::AssertionSuccess() << "thrown: \"" << message << "\"";
    }
    return testing::AssertionFailure()
      << "thrown: \"" << message << "\", expected \"" << words << "\"";
  }
  return testing::AssertionFailure() << "nothing thrown, expected \"" << words << "\"";
}

#endif
