// The state of a surface in a file, a .vdb with metadata, to be taken up again later.

#ifndef StateFile_h
#define StateFile_h

#include "NarrowBand.h"
#include "Simulation/SurfaceHistory.h"

#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

struct SavedState
{
  std::shared_ptr<const NarrowBand> Band;
  double Time = 0.0;               // pipeline time, of a step
  std::vector<HistoryRow> History; // up to it
};

// Rows as the text that is in a state.
std::string WriteHistory(const std::vector<HistoryRow>& rows);

// Throws std::runtime_error if the file cannot be written; then there is none, or the one before.
void WriteState(const std::string& file, const SavedState& state);

// Throws std::runtime_error for a file that cannot be read or holds no state.
SavedState ReadState(const std::string& file);

}

#endif
