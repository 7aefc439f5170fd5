#include "vtkActiveVDBReader.h"

#include "Grids/GridChoice.h"
#include "Grids/GridFacts.h"
#include "Grids/ImageArrays.h"
#include "Grids/ImageReading.h"
#include "Grids/PointArrays.h"
#include "Grids/VDBSeries.h"

#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <exception>
#include <new>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;
using activesurface::ImagePlace;
using activesurface::VDBGrid;

vtkStandardNewMacro(vtkActiveVDBReader);

struct vtkActiveVDBReader::Internals
{
  activesurface::VDBSeries Series;
  vtkNew<vtkStringArray> Names; // of all grids, for GetGridNames

  // Region as a box in voxels.
  openvdb::CoordBBox FindBox(const vtkActiveVDBReader* reader) const;
};

namespace
{

bool IsOtherPiece(vtkInformation* output)
{
  return output->Has(SDDP::UPDATE_PIECE_NUMBER()) && output->Get(SDDP::UPDATE_PIECE_NUMBER()) > 0;
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

void vtkActiveVDBReader::OpenFile(vtkInformation* output)
{
  activesurface::VDBSeries& series = this->Internal->Series;
  series.FindTimes(this->FileNames, this->GetMTime());
  const int file = output->Has(SDDP::UPDATE_TIME_STEP())
    ? series.FindFile(output->Get(SDDP::UPDATE_TIME_STEP()))
    : 0;
  series.Open(this->FileNames, this->GridNames, file, this->GetMTime());
}

openvdb::CoordBBox vtkActiveVDBReader::Internals::FindBox(const vtkActiveVDBReader* reader) const
{
  if (reader->Region == INDEX)
  {
    return activesurface::FindVoxels(reader->IndexRegion);
  }
  if (reader->Region == WORLD)
  {
    return activesurface::FindVoxels(
      *this->Series.GetChosen().front().Transform, reader->WorldRegion);
  }
  return this->Series.FindActiveBox();
}

// Errors are reported by RequestInformation, which runs next.
int vtkActiveVDBReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  try
  {
    this->OpenFile(out);
  }
  catch (const std::exception&)
  {
    this->Internal->Series.Close();
  }
  vtkDataObject* data = vtkDataObject::GetData(out);
  const bool isOfPoints = this->Internal->Series.IsOfPoints();
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
  if (!own.Series.IsOfPoints())
  {
    const ImagePlace place = activesurface::MakeImagePlace(
      *own.Series.GetChosen().front().Transform, own.FindBox(this), this->DownsamplingFactor);
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
    this->OpenFile(out);
    this->PublishExtent(out);
  }
  catch (const std::exception& error)
  {
    return this->Fail(output, error.what());
  }
  const std::vector<double>& times = this->Internal->Series.GetTimes();
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
    this->OpenFile(out);
    const activesurface::VDBSeries& series = this->Internal->Series;
    vtkDataObject* data = vtkDataObject::GetData(out);
    data->Initialize();
    auto image = vtkImageData::SafeDownCast(data);
    if (series.IsOfPoints() == (image != nullptr))
    {
      throw std::runtime_error("The files of the series have grids of different kinds, points and "
                               "volumes; choose one by GridName.");
    }
    if (!IsOtherPiece(out))
    {
      this->FillOutput(data);
    }
    if (series.GetTimes().size() > 1)
    {
      data->GetInformation()->Set(
        vtkDataObject::DATA_TIME_STEP(), series.GetTimes()[series.GetFileNumber()]);
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

void vtkActiveVDBReader::FillOutput(vtkDataObject* data)
{
  if (auto image = vtkImageData::SafeDownCast(data))
  {
    this->MakeImage(image);
  }
  else
  {
    this->MakePoints(vtkPolyData::SafeDownCast(data));
  }
}

void vtkActiveVDBReader::MakeImage(vtkImageData* image)
{
  activesurface::ImageRequest request;
  request.Box = this->Internal->FindBox(this);
  request.IsPart = this->Region != ACTIVE && !request.Box.empty();
  request.DownsamplingFactor = this->DownsamplingFactor;
  request.IsDense = this->OutputDense != 0;
  request.MaximumNumberOfPoints = this->MaximumNumberOfPoints;
  activesurface::ReadImage(this->Internal->Series, request, image);
}

void vtkActiveVDBReader::MakePoints(vtkPolyData* points)
{
  const Internals& own = *this->Internal;
  const openvdb::GridBase::Ptr grid =
    activesurface::ReadVDBGrid(own.Series.GetFileName(), own.Series.GetChosen().front());
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

int vtkActiveVDBReader::GetNumberOfGrids()
{
  return static_cast<int>(this->Internal->Series.GetFile().Grids.size());
}

vtkStringArray* vtkActiveVDBReader::GetGridNames()
{
  vtkStringArray* names = this->Internal->Names;
  names->SetNumberOfValues(0);
  for (const VDBGrid& grid : this->Internal->Series.GetFile().Grids)
  {
    names->InsertNextValue(grid.Name);
  }
  return names;
}

const char* vtkActiveVDBReader::GetGridName(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return grid ? grid->Name.c_str() : "";
}

const char* vtkActiveVDBReader::GetGridType(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return grid ? grid->GetValueType() : "";
}

const char* vtkActiveVDBReader::GetGridClass(int i)
{
  return activesurface::GetGridClass(this->Internal->Series.FindGrid(i));
}

bool vtkActiveVDBReader::GetGridIsHalfFloat(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return grid && grid->IsHalf;
}

bool vtkActiveVDBReader::GetGridIsInstance(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return grid && !grid->Parent.empty();
}

vtkIdType vtkActiveVDBReader::GetGridActiveVoxels(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return grid ? static_cast<vtkIdType>(grid->ActiveVoxels) : 0;
}

void vtkActiveVDBReader::GetGridBox(int i, int box[6])
{
  activesurface::GetActiveBox(this->Internal->Series.FindGrid(i), box);
}

void vtkActiveVDBReader::GetGridVoxelSize(int i, double size[3])
{
  activesurface::GetVoxelSize(this->Internal->Series.FindGrid(i), size);
}

std::string vtkActiveVDBReader::GetMetadata(const std::string& name)
{
  return activesurface::GetMetadata(this->Internal->Series.GetFile().Metadata.get(), name);
}

std::string vtkActiveVDBReader::GetAllMetadata()
{
  return activesurface::GetAllMetadata(this->Internal->Series.GetFile().Metadata.get());
}

std::string vtkActiveVDBReader::GetGridMetadata(int i, const std::string& name)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return activesurface::GetMetadata(grid ? grid->Metadata.get() : nullptr, name);
}

std::string vtkActiveVDBReader::GetAllGridMetadata(int i)
{
  const VDBGrid* grid = this->Internal->Series.FindGrid(i);
  return activesurface::GetAllMetadata(grid ? grid->Metadata.get() : nullptr);
}

void vtkActiveVDBReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto list = [&os, indent](const char* title, const auto& values)
  {
    os << indent << title << ":";
    for (const auto& value : values)
    {
      os << " " << value;
    }
    os << "\n";
  };
  list("FileName", this->FileNames);
  list("GridName", this->GridNames);
  list("IndexRegion", this->IndexRegion);
  list("WorldRegion", this->WorldRegion);
  os << indent << "Region: " << this->Region << "\n"
     << indent << "DownsamplingFactor: " << this->DownsamplingFactor << "\n"
     << indent << "OutputDense: " << this->OutputDense << "\n"
     << indent << "MaximumNumberOfPoints: " << this->MaximumNumberOfPoints << "\n";
}
