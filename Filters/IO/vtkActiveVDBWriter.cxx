#include "vtkActiveVDBWriter.h"

#include "Base/OpenVDB.h"
#include "Base/TimeSteps.h"
#include "Common/FileError.h"
#include "Common/FileSeries.h"
#include "Grids/VDBContent.h"
#include "Grids/VDBOutput.h"
#include "Input/AttachedData.h"
#include "Input/WholeInput.h"

#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <openvdb/io/Compression.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

using SDDP = vtkStreamingDemandDrivenPipeline;
using activesurface::FileError;

vtkStandardNewMacro(vtkActiveVDBWriter);

namespace
{

constexpr const char* Creator = "Active Implicit Surfaces for VTK " ACTIVE_VERSION;

// Returns the data of the input. In ParaView a post filter copies the data of each filter; the
// original is returned.
vtkDataObject* FindData(vtkAlgorithm* consumer)
{
  int port = 0;
  vtkAlgorithm* producer = consumer->GetInputAlgorithm(0, 0, port);
  const bool isOfParaView = std::strcmp(producer->GetClassName(), "vtkPVPostFilter") == 0 &&
    producer->GetNumberOfInputConnections(0) > 0;
  return isOfParaView ? FindData(producer) : producer->GetOutputDataObject(port);
}

// The port of the input and its time steps.
struct Source
{
  explicit Source(vtkAlgorithm* consumer)
  {
    int port = 0;
    vtkAlgorithm* producer = consumer->GetInputAlgorithm(0, 0, port);
    this->Port = port;
    this->Pipeline = SDDP::SafeDownCast(producer->GetExecutive());
    if (!this->Pipeline || !this->Pipeline->UpdateInformation())
    {
      throw std::runtime_error("The input failed in RequestInformation, so no file is written; see "
                               "the error of the input.");
    }
    this->Information = this->Pipeline->GetOutputInformation(port);
    if (this->Information->Has(SDDP::TIME_STEPS()))
    {
      const double* first = this->Information->Get(SDDP::TIME_STEPS());
      this->Steps.assign(first, first + this->Information->Length(SDDP::TIME_STEPS()));
    }
  }

  void Update() const
  {
    activesurface::RequestWhole(this->Information);
    if (!this->Pipeline->Update(this->Port))
    {
      throw std::runtime_error(
        "The update of the input failed, so no file is written for this time; see the error of "
        "the input.");
    }
  }

  void Update(double time) const
  {
    this->Information->Set(SDDP::UPDATE_TIME_STEP(), time);
    this->Update();
  }

  int FindStep(double time) const
  {
    return this->Steps.empty() ? 0 : activesurface::FindStep(this->Steps, time).Step;
  }

  SDDP* Pipeline = nullptr;
  int Port = 0;
  vtkInformation* Information = nullptr;
  std::vector<double> Steps;
};

std::uint32_t GetFlags(int compression)
{
  using namespace openvdb::io;
  constexpr std::uint32_t flags[] = { COMPRESS_NONE, COMPRESS_ACTIVE_MASK,
    COMPRESS_ACTIVE_MASK | COMPRESS_ZIP, COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC };
  return flags[compression];
}

bool HasTime(vtkDataObject* data)
{
  return data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()) != 0;
}

double GetTime(vtkDataObject* data)
{
  return HasTime(data) ? data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()) : 0.0;
}

openvdb::MetaMap MakeMetadata(vtkDataObject* data, int frame, const std::string& units)
{
  openvdb::MetaMap metadata;
  metadata.insertMeta(openvdb::GridBase::META_GRID_CREATOR, openvdb::StringMetadata(Creator));
  metadata.insertMeta("time", openvdb::DoubleMetadata(GetTime(data)));
  metadata.insertMeta("frame", openvdb::Int32Metadata(frame));
  metadata.insertMeta("units", openvdb::StringMetadata(units));
  if (const auto attached = activesurface::GetAttachedState(data->GetInformation()))
  {
    for (const auto& [name, value] : attached->Motion)
    {
      metadata.insertMeta("motion_" + name, openvdb::DoubleMetadata(value));
    }
  }
  return metadata;
}

// Returns true on rank 0. Null controller: a single process.
bool IsFirstRank(vtkMultiProcessController* controller)
{
  return !controller || controller->GetLocalProcessId() == 0;
}

// Collective. Runs a task on each rank. Throws on all ranks if the task has failed on any rank.
// Every rank has to call this function the same number of times.
template <class Task>
void RunOnAllRanks(vtkMultiProcessController* controller, Task&& task)
{
  std::exception_ptr error;
  try
  {
    task();
  }
  catch (...)
  {
    error = std::current_exception();
  }
  const int hasFailed = error ? 1 : 0;
  int hasAnyFailed = hasFailed;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    controller->AllReduce(&hasFailed, &hasAnyFailed, 1, vtkCommunicator::MAX_OP);
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
  if (hasAnyFailed)
  {
    throw std::runtime_error(
      "Another rank failed, so the file is not written; see the error on that rank.");
  }
}

}

vtkActiveVDBWriter::vtkActiveVDBWriter()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(0);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkActiveVDBWriter::~vtkActiveVDBWriter() = default;

void vtkActiveVDBWriter::SetFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->FileName != wanted)
  {
    this->FileName = wanted;
    this->Modified();
  }
}

void vtkActiveVDBWriter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkActiveVDBWriter::GetController()
{
  return this->Controller;
}

void vtkActiveVDBWriter::SetUnits(const char* units)
{
  const std::string wanted = units ? units : "";
  if (this->Units != wanted)
  {
    this->Units = wanted;
    this->Modified();
  }
}

int vtkActiveVDBWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkActiveVDBWriter::Write()
{
  const auto fail = [this](unsigned long code, const char* sentence)
  {
    this->SetErrorCode(code);
    vtkErrorMacro(<< sentence);
    return 0;
  };
  this->SetErrorCode(vtkErrorCode::NoError);
  if (this->FileName.empty())
  {
    return fail(
      vtkErrorCode::NoFileNameError, "FileName is not set; set it to the .vdb file to write.");
  }
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    return fail(vtkErrorCode::UserError,
      "There is no input to write; connect a skin, a closed mesh or an image.");
  }
  try
  {
    openvdb::initialize();
    this->WriteSteps();
    return 1;
  }
  catch (const FileError& error)
  {
    return fail(error.GetCode(), error.what());
  }
  catch (const std::bad_alloc&)
  {
    return fail(vtkErrorCode::UserError,
      "There is not enough memory for the grids of the file; use larger voxels, or write fewer "
      "grids.");
  }
  catch (const std::exception& error)
  {
    return fail(vtkErrorCode::UserError, error.what());
  }
}

void vtkActiveVDBWriter::WriteSteps()
{
  using activesurface::MakeFrameName;
  std::optional<Source> source;
  RunOnAllRanks(this->Controller, [&] { source.emplace(this); });
  if (!this->WriteAllTimeSteps)
  {
    RunOnAllRanks(this->Controller, [&] { source->Update(); });
    RunOnAllRanks(this->Controller,
      [&]
      {
        vtkDataObject* data = FindData(this);
        const int frame = data ? source->FindStep(GetTime(data)) : 0;
        this->WriteData(MakeFrameName(this->FileName, frame, false), data, frame);
      });
    return;
  }
  const std::vector<double> steps =
    source->Steps.empty() ? std::vector<double>{ 0.0 } : source->Steps;
  this->UpdateProgress(0.0);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    RunOnAllRanks(this->Controller,
      [&]
      {
        if (this->GetAbortExecute())
        {
          throw std::runtime_error("Writing was stopped before the time step " + std::to_string(i) +
            " (counted from 0); " +
            (i > 0 ? "the files of the earlier time steps are complete." : "no file is written."));
        }
        source->Update(steps[i]);
      });
    const int frame = static_cast<int>(i);
    RunOnAllRanks(this->Controller,
      [&] { this->WriteData(MakeFrameName(this->FileName, frame, true), FindData(this), frame); });
    this->UpdateProgress(static_cast<double>(i + 1) / static_cast<double>(steps.size()));
  }
}

// Rank 0 writes. Collective if the input's state is distributed (Gather).
void vtkActiveVDBWriter::WriteData(const std::string& file, vtkDataObject* data, int frame)
{
  auto attached = data ? activesurface::GetAttachedState(data->GetInformation()) : nullptr;
  if (attached && attached->Gather)
  {
    attached = attached->Gather();
  }
  if (!IsFirstRank(this->Controller))
  {
    return;
  }
  activesurface::VDBChoice choice;
  choice.State = this->WriteState != 0;
  choice.Density = this->WriteDensity != 0;
  choice.Velocity = this->WriteVelocity != 0;
  choice.PointArrays = this->WritePointArrays != 0;
  choice.HalfFloat = this->HalfFloat != 0;
  constexpr openvdb::GridClass kinds[] = { openvdb::GRID_UNKNOWN, openvdb::GRID_LEVEL_SET,
    openvdb::GRID_FOG_VOLUME };
  choice.Kind = kinds[this->GridClass];
  choice.VoxelSize = this->VoxelSize;
  activesurface::WriteVDB(file, activesurface::MakeGrids(data, attached, choice),
    MakeMetadata(data, frame, this->Units), GetFlags(this->Compression));
}

void vtkActiveVDBWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "WriteAllTimeSteps: " << this->WriteAllTimeSteps << "\n"
     << indent << "WriteState: " << this->WriteState << "\n"
     << indent << "WriteDensity: " << this->WriteDensity << "\n"
     << indent << "WriteVelocity: " << this->WriteVelocity << "\n"
     << indent << "WritePointArrays: " << this->WritePointArrays << "\n"
     << indent << "GridClass: " << this->GridClass << "\n"
     << indent << "VoxelSize: " << this->VoxelSize << "\n"
     << indent << "HalfFloat: " << this->HalfFloat << "\n"
     << indent << "Compression: " << this->Compression << "\n"
     << indent << "Units: " << this->Units << "\n"
     << indent << "Controller: " << this->Controller << "\n";
}
