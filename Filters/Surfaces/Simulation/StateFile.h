// Writes and reads the state from which a surface resumes: a .vdb file with metadata.

#ifndef StateFile_h
#define StateFile_h

#include "SavedState.h"

#include <string>

namespace activesurface
{

// Throws std::runtime_error if there is no state or the file cannot be written, and std::bad_alloc.
// An existing file is then kept.
void WriteState(const std::string& file, const SavedState& state);

// Throws std::runtime_error if the file cannot be read or contains no state, and std::bad_alloc.
SavedState ReadState(const std::string& file);

}

#endif
