#include "Grids/VDBSeries.h"

#include "Grids/GridChoice.h"
#include "TimeSteps.h"

#include <cmath>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Returns NaN if there is no time or it is not a number.
double GetTime(const openvdb::MetaMap& metadata)
{
  if (const auto number = metadata.getMetadata<openvdb::DoubleMetadata>("time"))
  {
    return number->value();
  }
  const auto number = metadata.getMetadata<openvdb::FloatMetadata>("time");
  return number ? number->value() : std::nan("");
}

double GetTime(const VDBFile& file)
{
  const double time = GetTime(*file.Metadata);
  return std::isnan(time) && !file.Grids.empty() ? GetTime(*file.Grids.front().Metadata) : time;
}

}

void VDBSeries::Open(const std::vector<std::string>& files,
  const std::vector<std::string>& gridNames, int number, Version version)
{
  if (this->FileVersion == version && this->FileNumber == number)
  {
    return;
  }
  this->FileVersion = 0;
  this->File = VDBFile();
  this->Chosen.clear();
  if (files.empty())
  {
    throw std::invalid_argument("There is no FileName to read.");
  }
  this->FileName = files[number];
  this->File = ValidateVDB(this->FileName);
  this->Chosen = ChooseGrids(this->File, gridNames);
  this->FileVersion = version;
  this->FileNumber = number;
}

void VDBSeries::Close()
{
  this->Chosen.clear();
}

void VDBSeries::FindTimes(const std::vector<std::string>& files, Version version)
{
  if (this->TimesVersion == version)
  {
    return;
  }
  this->Times.clear();
  bool areKnown = true;
  for (const std::string& name : files)
  {
    const double time = GetTime(ValidateVDB(name, false));
    areKnown =
      areKnown && std::isfinite(time) && (this->Times.empty() || time > this->Times.back());
    this->Times.push_back(time);
  }
  for (std::size_t i = 0; !areKnown && i < this->Times.size(); ++i)
  {
    this->Times[i] = static_cast<double>(i);
  }
  this->TimesVersion = version;
}

int VDBSeries::FindFile(double time) const
{
  return this->Times.empty() ? 0 : FindStep(this->Times, time).Step;
}

const VDBGrid* VDBSeries::FindGrid(int i) const
{
  return i >= 0 && i < static_cast<int>(this->File.Grids.size()) ? &this->File.Grids[i] : nullptr;
}

bool VDBSeries::IsOfPoints() const
{
  return !this->Chosen.empty() && std::string(this->Chosen.front().GetValueType()) == "points";
}

openvdb::CoordBBox VDBSeries::FindActiveBox() const
{
  openvdb::CoordBBox box;
  for (const VDBGrid& grid : this->Chosen)
  {
    box.expand(grid.ActiveBox);
  }
  return box;
}

}
