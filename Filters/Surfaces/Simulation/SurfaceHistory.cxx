#include "Simulation/SurfaceHistory.h"

#include "NarrowBand.h"
#include "Surface/SkinEvents.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

void HistoryRecorder::Clear()
{
  this->Rows.clear();
  this->Interrupt();
}

void HistoryRecorder::Interrupt()
{
  this->Parts.clear();
  this->HasParts = false;
  this->Before.reset();
}

void HistoryRecorder::ContinueFrom(const std::shared_ptr<const NarrowBand>& band)
{
  this->Interrupt();
  if (band->GetPart()) // FindSkinParts is collective, so Record calls it later
  {
    this->Before = band;
    return;
  }
  this->Parts = FindSkinParts(*band);
  this->HasParts = true;
}

HistoryRow HistoryRecorder::MakeRow(const NarrowBand& band, const RecordedState& moment)
{
  if (this->Before)
  {
    this->Parts = FindSkinParts(*this->Before);
    this->HasParts = true;
    this->Before.reset();
  }
  std::vector<SkinPart> parts = FindSkinParts(band);
  HistoryRow row;
  row.Time = moment.Time.Value;
  row.Outside = moment.Outside;
  row.Substeps = band.GetWork().Substeps;
  row.MaxSpeed = band.GetWork().MaxSpeed;
  row.ActiveVoxels = band.GetNumberOfActiveNodes();
  row.Event = !moment.Event.empty() ? moment.Event
    : this->HasParts                ? FindEvents(this->Parts, parts)
                                    : "";
  for (const SkinPart& part : parts)
  {
    row.Area += part.Area;
    row.Volume += part.Volume;
    ++(part.IsVoid() ? row.Voids : row.Components);
    row.EulerCharacteristic += part.EulerCharacteristic;
  }
  this->Parts = std::move(parts);
  this->HasParts = true;
  return row;
}

void HistoryRecorder::Record(std::size_t row, const NarrowBand& band, const RecordedState& moment)
{
  this->Rows.resize(std::max(this->Rows.size(), row + 1));
  this->Rows[row] = this->MakeRow(band, moment);
}

double HistoryRecorder::GetOutside(std::size_t row) const
{
  return row < this->Rows.size() ? this->Rows[row].Outside : std::nan("");
}

void HistoryRecorder::Restore(const std::vector<HistoryRow>& rows)
{
  if (this->Rows.size() < rows.size())
  {
    this->Rows = rows;
  }
}

void HistoryRecorder::SetFirstTime(PipelineTime time)
{
  if (!this->Rows.empty())
  {
    this->Rows.front().Time = time.Value;
  }
}

std::vector<HistoryRow> HistoryRecorder::GetRows(std::size_t most) const
{
  const auto end = this->Rows.begin() + std::min(most, this->Rows.size());
  return std::vector<HistoryRow>(this->Rows.begin(), end);
}

}
