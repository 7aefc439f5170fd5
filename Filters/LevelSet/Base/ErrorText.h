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

/** Returns what() of an error. For std::bad_alloc, whose what() is only the name of the class,
 * returns a sentence. */
inline std::string TextOf(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error)
    ? "There is not enough memory; free memory, or use fewer points, pixels or voxels."
    : error.what();
}

}

#endif
