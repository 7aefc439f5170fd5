// The state of a surface in a file, a .vdb with metadata, to be taken up again later.

#ifndef StateFile_h
#define StateFile_h

#include "SavedState.h"

#include <string>

namespace activesurface
{

// Throws std::runtime_error if there is no state, or the file cannot be written; then there is
// none, or the one before.
void WriteState(const std::string& file, const SavedState& state);

// Throws std::runtime_error for a file that cannot be read or holds no state.
SavedState ReadState(const std::string& file);

}

#endif
