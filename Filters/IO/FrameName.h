// Names of the files of a series.

#ifndef FrameName_h
#define FrameName_h

#include <string>

namespace activesurface
{

// Inserts the number into the pattern. It replaces the last run of # in the file's name, padded to
// the run's length, else %d or %0Nd. Without a placeholder, and if `always`, four digits are put
// before the extension.
std::string MakeFrameName(const std::string& pattern, int number, bool always);

}

#endif
