/**
 * The text of an error, for messages.
 */
#ifndef ErrorText_h
#define ErrorText_h

#include <exception>
#include <new>
#include <string>

namespace activesurface
{

/** Returns what() of an error; for lack of memory, whose what() is a name of C++, a sentence. */
inline std::string TextOf(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error)
    ? "There is not enough memory; free memory, or use fewer points, pixels or voxels."
    : error.what();
}

}

#endif
