// Records the history of a surface: measures and events at each step.

#ifndef SurfaceHistory_h
#define SurfaceHistory_h

#include "HistoryRow.h"
#include "Simulation/Times.h"
#include "Surface/SkinParts.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace activesurface
{

class NarrowBand;

struct RecordedState
{
  PipelineTime Time;
  double Outside;    // fraction of the target outside the skin
  std::string Event; // empty: found by comparison with the row before
};

// Rows of the history, up to the latest step that was reached, even after a return to an earlier
// step. Keeps the parts of the skin at the last row, to find the events of the next row.
class HistoryRecorder
{
public:
  void Clear();

  // Interrupt deletes the stored parts of the skin, so no event is found for the next row.
  // ContinueFrom stores the parts of a band instead, so the next row has the events since that
  // band. Both functions keep the rows.
  void Interrupt();
  void ContinueFrom(const std::shared_ptr<const NarrowBand>& band);

  // Records the state of the band, and the work since the previous row. Collective if the band is
  // partitioned among ranks: then only rank 0 gets the measures of the skin.
  void Record(std::size_t row, const NarrowBand& band, const RecordedState& moment);

  // Returns the fraction of the target outside the skin in a row; NaN without such a row.
  double GetOutside(std::size_t row) const;

  // Replaces the rows by those of a loaded state, unless as many or more rows are recorded already.
  void Restore(const std::vector<HistoryRow>& rows);

  // Sets the time of the first row. This time changes from StartTime to the input's first time step
  // when an input of one step gets more steps.
  void SetFirstTime(PipelineTime time);

  // Returns the first rows, `most` at most.
  std::vector<HistoryRow> GetRows(std::size_t most) const;

private:
  HistoryRow MakeRow(const NarrowBand& band, const RecordedState& moment);

  std::vector<HistoryRow> Rows;
  std::vector<SkinPart> Parts;
  bool HasParts = false;
  std::shared_ptr<const NarrowBand> Before; // band at the last row; Record finds its parts
};

}

#endif
