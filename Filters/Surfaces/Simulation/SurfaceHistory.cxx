#include "Simulation/SurfaceHistory.h"

#include "NarrowBand.h"
#include "SkinEvents.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <utility>

namespace activesurface
{

namespace
{

template <class Array, class Value>
void AddColumn(
  vtkTable* table, const char* name, const std::vector<HistoryRow>& rows, Value HistoryRow::*member)
{
  vtkNew<Array> column;
  column->SetName(name);
  for (const HistoryRow& row : rows)
  {
    column->InsertNextValue(row.*member);
  }
  table->AddColumn(column);
}

}

HistoryRow HistoryWriter::MakeRow(const NarrowBand& band, double time)
{
  std::vector<SkinPart> parts = FindSkinParts(band);
  HistoryRow row;
  row.Time = time;
  row.Substeps = band.GetWork().Substeps;
  row.MaxSpeed = band.GetWork().MaxSpeed;
  row.ActiveVoxels = band.GetNumberOfActiveNodes();
  row.Event = this->HasParts ? FindEvents(this->Parts, parts) : "";
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

void HistoryWriter::Restart(const NarrowBand& band)
{
  this->Parts = FindSkinParts(band);
  this->HasParts = true;
}

void FillHistory(const std::vector<HistoryRow>& rows, vtkTable* table)
{
  table->Initialize();
  AddColumn<vtkDoubleArray>(table, "Time", rows, &HistoryRow::Time);
  AddColumn<vtkIdTypeArray>(table, "Substeps", rows, &HistoryRow::Substeps);
  AddColumn<vtkDoubleArray>(table, "MaxSpeed", rows, &HistoryRow::MaxSpeed);
  AddColumn<vtkDoubleArray>(table, "Area", rows, &HistoryRow::Area);
  AddColumn<vtkDoubleArray>(table, "Volume", rows, &HistoryRow::Volume);
  AddColumn<vtkIdTypeArray>(table, "ActiveVoxels", rows, &HistoryRow::ActiveVoxels);
  AddColumn<vtkIdTypeArray>(table, "Components", rows, &HistoryRow::Components);
  AddColumn<vtkIdTypeArray>(table, "Voids", rows, &HistoryRow::Voids);
  AddColumn<vtkIdTypeArray>(table, "EulerCharacteristic", rows, &HistoryRow::EulerCharacteristic);
  AddColumn<vtkStringArray>(table, "Event", rows, &HistoryRow::Event);
}

}
