// What has become of a surface, step by step.

#ifndef SurfaceHistory_h
#define SurfaceHistory_h

#include "HistoryRow.h"
#include "Simulation/Times.h"
#include "SkinParts.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

class NarrowBand;

struct RecordedMoment
{
  PipelineTime Time;
  double Outside;    // share of the target outside the skin
  std::string Event; // replaces the one that is found, unless it is empty
};

// The rows of a surface on its way, of the farthest way so far. It remembers the parts of the skin
// at the row before, to tell what has happened to them.
class HistoryRecorder
{
public:
  void Clear();

  // The surface is not there any more, or at another place: rows stay, the next one tells no event;
  // or what has happened since this place.
  void Interrupt();
  void ContinueFrom(const std::shared_ptr<const NarrowBand>& band);

  // Records a surface that has just arrived at a time, with its work since the row before.
  // Collective where ranks share out space: only the first one records parts of the skin.
  void Record(std::size_t row, const NarrowBand& band, const RecordedMoment& moment);

  // The share outside of a row; NaN for one that is not known.
  double GetOutside(std::size_t row) const;

  // All rows of a state that was loaded, unless more are known.
  void Restore(const std::vector<HistoryRow>& rows);

  // The input has gone on before its first time.
  void SetFirstTime(PipelineTime time);

  // The first rows, so many at most.
  std::vector<HistoryRow> GetRows(std::size_t most) const;

private:
  HistoryRow MakeRow(const NarrowBand& band, const RecordedMoment& moment);

  std::vector<HistoryRow> Rows;
  std::vector<SkinPart> Parts;
  bool HasParts = false;
  std::shared_ptr<const NarrowBand> Before; // whose parts are found when they are needed
};

}

#endif
