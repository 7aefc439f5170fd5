#include "vtkActiveVDBReader.h"

#include "CarriedData.h"
#include "Grids/GridChoice.h"
#include "Grids/ImageArrays.h"
#include "Grids/PointArrays.h"
#include "Grids/VDBReaderState.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;
using activesurface::ImagePlace;
using activesurface::VDBFile;
using activesurface::VDBGrid;

vtkStandardNewMacro(vtkActiveVDBReader);

namespace
{

// NaN if it is not there, or no number.
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

openvdb::FloatGrid::ConstPtr AsLevelSet(const openvdb::GridBase::Ptr& grid)
{
  if (grid->getGridClass() != openvdb::GRID_LEVEL_SET)
  {
    return nullptr;
  }
  const auto wide = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid);
  return wide ? std::make_shared<openvdb::FloatGrid>(*wide)
              : openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
}

bool IsOtherPiece(vtkInformation* output)
{
  return output->Has(SDDP::UPDATE_PIECE_NUMBER()) && output->Get(SDDP::UPDATE_PIECE_NUMBER()) > 0;
}

void Place(const ImagePlace& place, vtkImageData* image)
{
  image->SetExtent(const_cast<int*>(place.Extent));
  image->SetOrigin(place.Origin);
  image->SetSpacing(place.Spacing);
  image->SetDirectionMatrix(place.Direction);
}

}

vtkActiveVDBReader::vtkActiveVDBReader()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkActiveVDBReader::~vtkActiveVDBReader() = default;

void vtkActiveVDBReader::SetFileName(const char* name)
{
  const std::vector<std::string> wanted =
    name && *name ? std::vector<std::string>{ name } : std::vector<std::string>();
  if (this->FileNames != wanted)
  {
    this->FileNames = wanted;
    this->Modified();
  }
}

void vtkActiveVDBReader::AddFileName(const char* name)
{
  this->FileNames.emplace_back(name ? name : "");
  this->Modified();
}

void vtkActiveVDBReader::ClearFileNames()
{
  this->SetFileName(nullptr);
}

const char* vtkActiveVDBReader::GetFileName(int i) const
{
  return i >= 0 && i < this->GetNumberOfFileNames() ? this->FileNames[i].c_str() : "";
}

void vtkActiveVDBReader::SetGridName(const char* name)
{
  const std::vector<std::string> wanted =
    name && *name ? std::vector<std::string>{ name } : std::vector<std::string>();
  if (this->GridNames != wanted)
  {
    this->GridNames = wanted;
    this->Modified();
  }
}

void vtkActiveVDBReader::AddGridName(const char* name)
{
  this->GridNames.emplace_back(name ? name : "");
  this->Modified();
}

void vtkActiveVDBReader::ClearGridNames()
{
  this->SetGridName(nullptr);
}

int vtkActiveVDBReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataSet");
  return 1;
}

void vtkActiveVDBReader::LookAt(int file)
{
  Internals& own = *this->Internal;
  if (own.LookedAt == this->GetMTime() && own.FileNumber == file)
  {
    return;
  }
  own.LookedAt = 0;
  own.File = VDBFile();
  own.Chosen.clear();
  if (this->FileNames.empty())
  {
    throw std::invalid_argument("There is no FileName to read.");
  }
  own.File = activesurface::LookThroughVDB(this->FileNames[file]);
  own.Chosen = activesurface::ChooseGrids(own.File, this->GridNames);
  own.LookedAt = this->GetMTime();
  own.FileNumber = file;
}

void vtkActiveVDBReader::FindTimes()
{
  Internals& own = *this->Internal;
  if (own.TimesOf == this->GetMTime())
  {
    return;
  }
  own.Times.clear();
  bool areKnown = true;
  for (const std::string& name : this->FileNames)
  {
    const double time = GetTime(activesurface::LookThroughVDB(name, false));
    areKnown = areKnown && std::isfinite(time) && (own.Times.empty() || time > own.Times.back());
    own.Times.push_back(time);
  }
  for (std::size_t i = 0; !areKnown && i < own.Times.size(); ++i)
  {
    own.Times[i] = static_cast<double>(i);
  }
  own.TimesOf = this->GetMTime();
}

int vtkActiveVDBReader::FindFile(vtkInformation* output) const
{
  const std::vector<double>& times = this->Internal->Times;
  if (!output->Has(SDDP::UPDATE_TIME_STEP()) || times.size() < 2)
  {
    return 0;
  }
  constexpr double rounding = 1e-9;
  const double time = output->Get(SDDP::UPDATE_TIME_STEP());
  const auto after =
    std::upper_bound(times.begin(), times.end(), time + rounding * std::fabs(time));
  return std::max(0, static_cast<int>(after - times.begin()) - 1);
}

// Errors are told by RequestInformation, which comes next.
int vtkActiveVDBReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  try
  {
    this->FindTimes();
    this->LookAt(this->FindFile(out));
  }
  catch (const std::exception&)
  {
    this->Internal->Chosen.clear();
  }
  vtkDataObject* data = vtkDataObject::GetData(out);
  const bool isOfPoints = this->Internal->IsOfPoints();
  if (!data || !data->IsA(isOfPoints ? "vtkPolyData" : "vtkImageData"))
  {
    vtkSmartPointer<vtkDataObject> made;
    made.TakeReference(isOfPoints ? static_cast<vtkDataObject*>(vtkPolyData::New())
                                  : static_cast<vtkDataObject*>(vtkImageData::New()));
    out->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

int vtkActiveVDBReader::Fail(vtkInformationVector* output, const char* sentence)
{
  vtkDataObject::GetData(output, 0)->Initialize();
  this->SetErrorCode(
    this->FileNames.empty() ? vtkErrorCode::NoFileNameError : vtkErrorCode::CannotOpenFileError);
  vtkErrorMacro(<< sentence);
  return 0;
}

void vtkActiveVDBReader::PublishExtent(vtkInformation* output) const
{
  const Internals& own = *this->Internal;
  output->Remove(SDDP::WHOLE_EXTENT());
  if (!own.IsOfPoints())
  {
    const ImagePlace place = activesurface::MakeImagePlace(
      *own.Chosen.front().Transform, own.FindBox(this), this->DownsamplingFactor);
    output->Set(SDDP::WHOLE_EXTENT(), place.Extent, 6);
  }
}

int vtkActiveVDBReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkInformation* out = output->GetInformationObject(0);
  try
  {
    this->FindTimes();
    this->LookAt(this->FindFile(out));
    this->PublishExtent(out);
  }
  catch (const std::exception& error)
  {
    return this->Fail(output, error.what());
  }
  const std::vector<double>& times = this->Internal->Times;
  out->Remove(SDDP::TIME_STEPS());
  out->Remove(SDDP::TIME_RANGE());
  if (times.size() > 1)
  {
    const double range[2] = { times.front(), times.back() };
    out->Set(SDDP::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    out->Set(SDDP::TIME_RANGE(), range, 2);
  }
  return 1;
}

int vtkActiveVDBReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  try
  {
    const int file = this->FindFile(out);
    this->LookAt(file);
    vtkDataObject* data = vtkDataObject::GetData(out);
    data->Initialize();
    auto image = vtkImageData::SafeDownCast(data);
    if (this->Internal->IsOfPoints() == (image != nullptr))
    {
      throw std::runtime_error("The files of the series have grids of different kinds, points and "
                               "volumes; choose one by GridName.");
    }
    if (!IsOtherPiece(out))
    {
      image ? this->MakeImage(image) : this->MakePoints(vtkPolyData::SafeDownCast(data));
    }
    if (this->Internal->Times.size() > 1)
    {
      data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), this->Internal->Times[file]);
    }
    if (image)
    {
      out->Set(SDDP::WHOLE_EXTENT(), image->GetExtent(), 6);
      out->Set(SDDP::UPDATE_EXTENT(), image->GetExtent(), 6);
    }
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    return this->Fail(output,
      "There is not enough memory for the grid; choose a smaller Region, a "
      "DownsamplingFactor, or OutputDense off.");
  }
  catch (const std::exception& error)
  {
    return this->Fail(output, error.what());
  }
}

void vtkActiveVDBReader::MakeImage(vtkImageData* image)
{
  const Internals& own = *this->Internal;
  const openvdb::math::Transform& transform = *own.Chosen.front().Transform;
  openvdb::CoordBBox box = own.FindBox(this);
  const ImagePlace place = activesurface::MakeImagePlace(transform, box, this->DownsamplingFactor);
  if (this->OutputDense && place.CountPoints() > static_cast<double>(this->MaximumNumberOfPoints))
  {
    std::ostringstream text;
    text << "The dense image would have " << place.CountPoints() << " points, more than "
         << "MaximumNumberOfPoints; choose a smaller Region, a DownsamplingFactor, or OutputDense "
         << "off, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
  const bool isPart = this->Region != ACTIVE && !box.empty();
  openvdb::BBoxd part;
  if (isPart)
  {
    box.expand(this->DownsamplingFactor);
    part = transform.indexToWorld(box);
  }
  Place(place, image);
  for (const VDBGrid& chosen : own.Chosen)
  {
    const openvdb::GridBase::Ptr grid =
      activesurface::ReadVDBGrid(this->FileNames[own.FileNumber], chosen, isPart ? &part : nullptr);
    if (this->OutputDense && image->GetNumberOfPoints() > 0)
    {
      const auto array =
        activesurface::MakeImageArray(*grid, place.Extent, this->DownsamplingFactor);
      array->SetName(chosen.Name.c_str());
      image->GetPointData()->AddArray(array);
    }
    if (&chosen == &own.Chosen.front())
    {
      activesurface::Carry(image->GetInformation(), AsLevelSet(grid));
    }
  }
  if (vtkDataArray* first = image->GetPointData()->GetArray(0))
  {
    first->GetNumberOfComponents() == 3 ? image->GetPointData()->SetVectors(first)
                                        : image->GetPointData()->SetScalars(first);
  }
}

void vtkActiveVDBReader::MakePoints(vtkPolyData* points)
{
  const Internals& own = *this->Internal;
  const openvdb::GridBase::Ptr grid =
    activesurface::ReadVDBGrid(this->FileNames[own.FileNumber], own.Chosen.front());
  activesurface::ReadPoints(*grid, this->MaximumNumberOfPoints, points);
}

vtkImageData* vtkActiveVDBReader::GetImageOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkPolyData* vtkActiveVDBReader::GetPolyDataOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

void vtkActiveVDBReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const std::string& name : this->FileNames)
  {
    os << indent << "FileName: " << name << "\n";
  }
  for (const std::string& name : this->GridNames)
  {
    os << indent << "GridName: " << name << "\n";
  }
  os << indent << "Region: " << this->Region << "\n"
     << indent << "DownsamplingFactor: " << this->DownsamplingFactor << "\n"
     << indent << "OutputDense: " << this->OutputDense << "\n"
     << indent << "MaximumNumberOfPoints: " << this->MaximumNumberOfPoints << "\n";
}
