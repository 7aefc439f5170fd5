#include "vtkActiveVDBReader.h"

#include "Base/ErrorText.h"
#include "Common/FileSeries.h"
#include "Grids/GridFacts.h"
#include "Grids/ImageReading.h"
#include "Grids/PointArrays.h"

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
  vtkMTimeType Version = 0; // MTime of the reader when the times were read
  activesurface::FileTimes Times;
  int Number = -1; // index of the open file; -1: none
  activesurface::ChosenGrids Chosen;
  vtkNew<vtkStringArray> Names; // names of all grids, for GetGridNames

  // Returns null if there is no such grid.
  const VDBGrid* FindGrid(int i) const
  {
    const std::vector<VDBGrid>& grids = this->Chosen.File.Grids;
    return i >= 0 && i < static_cast<int>(grids.size()) ? &grids[i] : nullptr;
  }

  // Returns the box that Region selects, in index coordinates.
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

// Opens the file of the requested time. If the reader was modified, first reads the times of all
// files.
void vtkActiveVDBReader::OpenFile(vtkInformation* output)
{
  Internals& own = *this->Internal;
  if (own.Version != this->GetMTime())
  {
    own.Chosen = {};
    own.Number = -1;
    own.Times = activesurface::FileTimes(activesurface::ReadTimes(this->FileNames));
    own.Version = this->GetMTime();
  }
  const int number = own.Times.FindFile(output);
  if (own.Number != number)
  {
    own.Chosen = {};
    own.Number = -1;
    own.Chosen = activesurface::ChooseGrids(this->FileNames[number], this->GridNames);
    own.Number = number;
  }
}

openvdb::CoordBBox vtkActiveVDBReader::Internals::FindBox(const vtkActiveVDBReader* reader) const
{
  if (reader->Region == INDEX)
  {
    return activesurface::FindVoxels(reader->IndexRegion);
  }
  if (reader->Region == WORLD)
  {
    return activesurface::FindVoxels(*this->Chosen.Grids.front().Transform, reader->WorldRegion);
  }
  return this->Chosen.FindActiveBox();
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
    this->Internal->Chosen.Grids.clear();
    this->Internal->Number = -1;
  }
  vtkDataObject* data = vtkDataObject::GetData(out);
  const bool isOfPoints = this->Internal->Chosen.AreOfPoints();
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
  if (!own.Chosen.AreOfPoints())
  {
    const ImagePlace place = activesurface::MakeImagePlace(
      *own.Chosen.Grids.front().Transform, own.FindBox(this), this->DownsamplingFactor);
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
    return this->Fail(output, activesurface::TextOf(error).c_str());
  }
  this->Internal->Times.Publish(out);
  return 1;
}

int vtkActiveVDBReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(0);
  try
  {
    this->OpenFile(out);
    const Internals& own = *this->Internal;
    vtkDataObject* data = vtkDataObject::GetData(out);
    data->Initialize();
    auto image = vtkImageData::SafeDownCast(data);
    if (own.Chosen.AreOfPoints() == (image != nullptr))
    {
      throw std::runtime_error("The files of the series have grids of different kinds, points and "
                               "volumes; choose grids of one kind by GridName, or read points and "
                               "volumes by two readers.");
    }
    if (!IsOtherPiece(out))
    {
      this->FillOutput(data);
    }
    own.Times.Mark(own.Number, data);
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
      "There is not enough memory for the grid; for a volume, choose a smaller part by Region, "
      "raise DownsamplingFactor, or turn OutputDense off.");
  }
  catch (const std::exception& error)
  {
    return this->Fail(output, error.what());
  }
}

void vtkActiveVDBReader::FillOutput(vtkDataObject* data)
{
  const Internals& own = *this->Internal;
  if (auto points = vtkPolyData::SafeDownCast(data))
  {
    const openvdb::GridBase::Ptr grid =
      activesurface::ReadVDBGrid(own.Chosen.FileName, own.Chosen.Grids.front());
    activesurface::ReadPoints(*grid, this->MaximumNumberOfPoints, points);
    return;
  }
  activesurface::ImageRequest request;
  request.Box = own.FindBox(this);
  request.IsPart = this->Region != ACTIVE && !request.Box.empty();
  request.DownsamplingFactor = this->DownsamplingFactor;
  request.IsDense = this->OutputDense != 0;
  request.MaximumNumberOfPoints = this->MaximumNumberOfPoints;
  activesurface::ReadImage(own.Chosen, request, vtkImageData::SafeDownCast(data));
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
  return static_cast<int>(this->Internal->Chosen.File.Grids.size());
}

vtkStringArray* vtkActiveVDBReader::GetGridNames()
{
  vtkStringArray* names = this->Internal->Names;
  names->SetNumberOfValues(0);
  for (const VDBGrid& grid : this->Internal->Chosen.File.Grids)
  {
    names->InsertNextValue(grid.Name);
  }
  return names;
}

const char* vtkActiveVDBReader::GetGridName(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return grid ? grid->Name.c_str() : "";
}

const char* vtkActiveVDBReader::GetGridType(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return grid ? grid->GetValueType() : "";
}

const char* vtkActiveVDBReader::GetGridClass(int i)
{
  return activesurface::GetGridClass(this->Internal->FindGrid(i));
}

bool vtkActiveVDBReader::GetGridIsHalfFloat(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return grid && grid->IsHalf;
}

bool vtkActiveVDBReader::GetGridIsInstance(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return grid && !grid->Parent.empty();
}

vtkIdType vtkActiveVDBReader::GetGridActiveVoxels(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return grid ? static_cast<vtkIdType>(grid->ActiveVoxels) : 0;
}

void vtkActiveVDBReader::GetGridBox(int i, int box[6])
{
  activesurface::GetActiveBox(this->Internal->FindGrid(i), box);
}

void vtkActiveVDBReader::GetGridVoxelSize(int i, double size[3])
{
  activesurface::GetVoxelSize(this->Internal->FindGrid(i), size);
}

std::string vtkActiveVDBReader::GetMetadata(const std::string& name)
{
  return activesurface::GetMetadata(this->Internal->Chosen.File.Metadata.get(), name);
}

std::string vtkActiveVDBReader::GetAllMetadata()
{
  return activesurface::GetAllMetadata(this->Internal->Chosen.File.Metadata.get());
}

std::string vtkActiveVDBReader::GetGridMetadata(int i, const std::string& name)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
  return activesurface::GetMetadata(grid ? grid->Metadata.get() : nullptr, name);
}

std::string vtkActiveVDBReader::GetAllGridMetadata(int i)
{
  const VDBGrid* grid = this->Internal->FindGrid(i);
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
