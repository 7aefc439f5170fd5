#include "Pipeline/OutputPorts.h"

#include "Input/AttachedData.h"
#include "NarrowBand.h"
#include "Pipeline/OutputShare.h"
#include "Pipeline/PublishedInformation.h"
#include "Pipeline/SkinArrays.h"
#include "Pipeline/SurfaceOutput.h"
#include "Pipeline/SurfaceProperties.h"
#include "Simulation/SurfaceSimulation.h"
#include "Surface/Skin.h"

#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

namespace
{

// Gathers the states of all ranks, with those arrays of the skin that need no particles. Returns
// null on ranks that do not receive the whole band. Collective.
std::shared_ptr<const AttachedState> GatherState(
  const AttachedState& part, bool normals, bool curvature)
{
  const std::shared_ptr<const NarrowBand> band = part.Skin->GatherWhole(false);
  if (!band)
  {
    return nullptr;
  }
  auto whole = std::make_shared<AttachedState>(part);
  whole->State.Band = whole->Skin = band;
  vtkNew<vtkPolyData> skin;
  vtkNew<vtkFloatArray> array;
  FillSkin(*band, normals ? array.Get() : nullptr, skin);
  whole->WholeArrays = skin->GetPointData();
  if (normals)
  {
    whole->WholeArrays->SetNormals(array);
  }
  if (curvature)
  {
    whole->WholeArrays->AddArray(MakeCurvature(*band));
  }
  return whole;
}

// Attaches the time and the surface's state to an output, for file writers. The simulation must be
// at the requested time. arrays: result of KeepShare for the skin; null for other outputs.
void AttachState(const OutputProperties& properties, const SurfaceSimulation& simulation,
  vtkDataObject* data, vtkPointData* arrays)
{
  const SurfaceSettings& settings = simulation.GetSettings();
  const RequestedTime& time = simulation.GetRequestedTime();
  PublishTime(data, time.Time, settings.IsEquilibrium());
  auto attached = std::make_shared<AttachedState>();
  attached->State = simulation.GetRequestedState();
  attached->Skin = simulation.ShareBand();
  attached->WholeArrays = arrays;
  attached->IsAtStep = simulation.IsAtStep();
  attached->Step = time.Step;
  attached->Motion = settings.ListForFiles();
  if (attached->Skin->GetPart())
  {
    attached->Gather = [part = *attached, properties]
    { return GatherState(part, properties.Normals, properties.Curvature); };
  }
  Attach(data->GetInformation(), attached);
}

using Ranges = std::vector<Skin::TriangleRange>;

// Calls visit(triangle) for each triangle of the ranges.
template <class Visit>
void ForEachTriangle(const Ranges& ranges, Visit&& visit)
{
  for (const Skin::TriangleRange& range : ranges)
  {
    for (std::size_t i = range.First; i < range.Last; ++i)
    {
      visit(static_cast<vtkIdType>(i));
    }
  }
}

// The points of the triangles, in the order of the skin; and for each point of the skin its index
// among these points, or -1.
struct UsedPoints
{
  vtkNew<vtkIdList> Points;
  std::vector<vtkIdType> Places;

  UsedPoints(vtkPolyData* skin, const Ranges& ranges)
    : Places(static_cast<std::size_t>(skin->GetNumberOfPoints()), -1)
  {
    vtkNew<vtkIdList> corners;
    ForEachTriangle(ranges,
      [&](vtkIdType i)
      {
        skin->GetPolys()->GetCellAtId(i, corners);
        for (vtkIdType corner : *corners)
        {
          this->Places[static_cast<std::size_t>(corner)] = 0;
        }
      });
    for (std::size_t i = 0; i < this->Places.size(); ++i)
    {
      if (this->Places[i] == 0)
      {
        this->Places[i] = this->Points->GetNumberOfIds();
        this->Points->InsertNextId(static_cast<vtkIdType>(i));
      }
    }
  }
};

vtkSmartPointer<vtkCellArray> Renumber(
  vtkCellArray* whole, const Ranges& ranges, const std::vector<vtkIdType>& places)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> corners;
  ForEachTriangle(ranges,
    [&](vtkIdType i)
    {
      whole->GetCellAtId(i, corners);
      for (vtkIdType& corner : *corners)
      {
        corner = places[static_cast<std::size_t>(corner)];
      }
      cells->InsertNextCell(corners);
    });
  return cells;
}

// points: indices in this rank's skin. numbers: for each point of this rank's skin, the index of
// the point in the skin of all ranks.
void AddGlobalIds(vtkIdList* points, const std::vector<std::int64_t>& numbers, vtkPointData* arrays)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  ids->SetNumberOfValues(points->GetNumberOfIds());
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
  {
    ids->SetValue(i, static_cast<vtkIdType>(numbers[static_cast<std::size_t>(points->GetId(i))]));
  }
  arrays->SetGlobalIds(ids);
}

// Returns the arrays at these points.
vtkSmartPointer<vtkPointData> CopyArrays(vtkPointData* whole, vtkIdList* points)
{
  vtkNew<vtkIdList> order;
  order->SetNumberOfIds(points->GetNumberOfIds());
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
  {
    order->SetId(i, i);
  }
  auto arrays = vtkSmartPointer<vtkPointData>::New();
  arrays->CopyAllOn();
  arrays->CopyAllocate(whole, points->GetNumberOfIds());
  arrays->CopyData(whole, points, order);
  return arrays;
}

void KeepTriangles(
  const Ranges& ranges, const std::vector<std::int64_t>& numbers, vtkPolyData* skin)
{
  const UsedPoints used(skin, ranges);
  vtkNew<vtkPoints> points;
  points->SetDataType(skin->GetPoints()->GetDataType());
  skin->GetPoints()->GetPoints(used.Points, points);
  const auto cells = Renumber(skin->GetPolys(), ranges, used.Places);
  const auto arrays = CopyArrays(skin->GetPointData(), used.Points);
  AddGlobalIds(used.Points, numbers, arrays);
  skin->SetPoints(points);
  skin->SetPolys(cells);
  skin->GetPointData()->ShallowCopy(arrays);
}

// Reduces a skin to this rank's triangles and their points, and adds the array "GlobalPointIds"
// with the point indices in the whole skin. Points at the border of two parts are in both parts,
// bitwise identical. Returns the arrays of the whole skin on rank 0, for writers, if the band is
// whole; otherwise null. Changes nothing for a filter of one process.
vtkSmartPointer<vtkPointData> KeepShare(
  const NarrowBand& band, const OutputShare& share, vtkPolyData* skin)
{
  if (share.IsAll())
  {
    return nullptr;
  }
  vtkSmartPointer<vtkPointData> whole;
  if (share.Rank == 0 && !band.GetPart())
  {
    whole = vtkSmartPointer<vtkPointData>::New();
    whole->ShallowCopy(skin->GetPointData());
  }
  const Skin triangles(band);
  KeepTriangles(triangles.ListTriangles(share.Rank, share.Size), triangles.NumberVertices(), skin);
  return whole;
}

// Returns true for the requested port, for the history, and for Potential if that output is on. On
// one process, a request for a piece other than piece 0 does not fill the history.
bool IsFilled(int port, const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector* output)
{
  const int requested = RequestedPort(request);
  const bool isWithHistory =
    !properties.Share.IsAll() || !IsOtherPiece(output->GetInformationObject(requested));
  return port == requested || (port == OutputPorts::History && isWithHistory) ||
    (port == OutputPorts::Potential && properties.Outputs.Potential);
}

void FillSkinPort(
  const OutputProperties& properties, const SurfaceSimulation& simulation, vtkPolyData* skin)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  const bool areNeeded = properties.Normals || NeedNormals(properties);
  FillSkin(simulation.GetBand(), areNeeded ? normals.Get() : nullptr, skin);
  if (properties.Normals)
  {
    skin->GetPointData()->SetNormals(normals);
  }
  AddSkinArrays(properties, simulation, normals, skin);
  MoveToWorld(simulation.GetOrigin(), skin);
}

void FillPort(int port, const SurfaceProperties& properties, const SurfaceSimulation& simulation,
  vtkInformation* output, vtkDataObject* data)
{
  switch (port)
  {
    case OutputPorts::Skin:
      FillSkinPort(properties.Outputs, simulation, vtkPolyData::SafeDownCast(data));
      break;
    case OutputPorts::Potential:
      RequestSomeExtent(output, properties.Share);
      FillPotential(simulation.GetBand(),
        output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()), simulation.GetOrigin(),
        vtkImageData::SafeDownCast(data));
      break;
    default:
      FillHistory(properties.Share.Rank == 0 ? simulation.GetHistory() : std::vector<HistoryRow>(),
        vtkTable::SafeDownCast(data));
  }
}

}

bool OutputPorts::IsForNothing(
  const OutputShare& share, vtkInformation* request, vtkInformationVector* output)
{
  const int port = RequestedPort(request);
  return share.IsAll() && port != Potential && IsOtherPiece(output->GetInformationObject(port));
}

void OutputPorts::MarkUnfilled(
  const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output)
{
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    if (!IsFilled(port, properties, request, output))
    {
      output->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
  }
}

void OutputPorts::Fill(const SurfaceProperties& properties, SurfaceSimulation& simulation,
  vtkInformation* request, vtkInformationVector* output)
{
  // The domain may not have been available before.
  PublishExtent(output->GetInformationObject(Potential), simulation.FindDomain());
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    if (IsFilled(port, properties, request, output))
    {
      vtkDataObject* data = vtkDataObject::GetData(output, port);
      FillPort(port, properties, simulation, output->GetInformationObject(port), data);
      AttachState(properties.Outputs, simulation, data,
        port == Skin
          ? KeepShare(simulation.GetBand(), properties.Share, vtkPolyData::SafeDownCast(data))
          : nullptr);
    }
  }
  this->AreFilled = true;
  this->Filled = simulation.GetRequestedTime();
  this->Function.Renew(&simulation.GetBand(), simulation.GetOrigin());
}

void OutputPorts::Clear(vtkInformationVector* output)
{
  this->AreFilled = false;
  this->Function.Renew(nullptr, {});
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* out = output->GetInformationObject(port);
    vtkDataObject::GetData(out)->Initialize();
    out->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

}
