// Names of the files of a series.

#ifndef SeriesName_h
#define SeriesName_h

#include <string>

namespace activesurface
{

// The last run of # in the file's name becomes the number with so many digits at least.
bool HasNumber(const std::string& pattern);

// Without a #, the number has four digits and stands before the extension: name.0007.vdb.
std::string MakeSeriesName(const std::string& pattern, int number);

}

#endif
