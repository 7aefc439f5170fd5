#include "Pipeline/SurfaceInput.h"

#include "Frames/ParticleData.h"
#include "Input/AttachedData.h"
#include "Input/WholeInput.h"
#include "Targets/ContentSum.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"
#include "Targets/OwnedParticles.h"
#include "Targets/ParticleShape.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

// VTK classes that both input ports accept, and further classes that port 0 accepts. AsDataSet
// converts trees and tables to a data set.
constexpr const char* InputTypes[] = { "vtkPointSet", "vtkImageData", "vtkDataObjectTree" };
constexpr const char* MoreTargetTypes[] = { "vtkTable" };

enum ArrayIndices
{
  RadiusArray = 0,
  IdArray = 1,
  StrengthArray = 2,
  ValueArray = 3,
  InitialValueArray = 4,
  VelocityArray = 5
};

std::string ListArrays(vtkPointData* arrays)
{
  std::string names;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    const char* name = arrays->GetArrayName(i);
    names += name ? (names.empty() ? "\"" : ", \"") + std::string(name) + "\"" : "";
  }
  return names.empty()
    ? "the input has no point arrays with names; add the array"
    : "choose association 0 (points) and one of the input's point arrays (if the input has blocks: "
      "arrays of all blocks): " +
      names;
}

// Returns true for a table without columns, which a rank receives if another rank has the data.
bool HasNothing(vtkDataObject* data)
{
  auto table = vtkTable::SafeDownCast(data);
  return table && table->GetNumberOfColumns() == 0;
}

}

// The user's chosen arrays in one data set.
class SurfaceInput::ArraysOf : public ChosenArrays
{
public:
  ArraysOf(const SurfaceInput& input, vtkDataSet* data)
    : Input(input)
    , Data(data)
  {
  }

  vtkAbstractArray* FindRadii() const override { return this->Find(RadiusArray); }
  vtkAbstractArray* FindIds() const override { return this->Find(IdArray); }
  vtkAbstractArray* FindStrengths() const override { return this->Find(StrengthArray); }
  vtkAbstractArray* FindVelocities() const override { return this->Find(VelocityArray); }
  vtkAbstractArray* FindValues() const override { return this->Input.FindValues(this->Data); }

private:
  vtkAbstractArray* Find(int index) const { return this->Input.FindArray(index, this->Data); }

  const SurfaceInput& Input;
  vtkDataSet* Data;
};

SurfaceInput::SurfaceInput(vtkAlgorithm* filter, Ports port, Agreement& ranks)
  : Filter(filter)
  , Port(port)
  , Ranks(ranks)
{
}

std::vector<const char*> SurfaceInput::ListTypes(int port)
{
  std::vector<const char*> types(std::begin(InputTypes), std::end(InputTypes));
  if (port == Target)
  {
    types.insert(types.end(), std::begin(MoreTargetTypes), std::end(MoreTargetTypes));
  }
  return types;
}

void SurfaceInput::DescribePort(int port, vtkInformation* information)
{
  for (const char* type : ListTypes(port))
  {
    information->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
}

bool SurfaceInput::Accepts(int port, vtkDataObject* data)
{
  const std::vector<const char*> types = ListTypes(port);
  return !HasLevels(data) &&
    std::any_of(types.begin(), types.end(), [data](const char* type) { return data->IsA(type); });
}

bool SurfaceInput::IsConnected() const
{
  return this->Filter->GetNumberOfInputConnections(this->Port) > 0;
}

bool SurfaceInput::IsArrayChosen(int index) const
{
  vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  return name ? *name != '\0' : choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()) != 0;
}

std::string SurfaceInput::DescribeArray(int index) const
{
  if (!this->IsArrayChosen(index))
  {
    return "";
  }
  vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  std::ostringstream text;
  text << "association " << choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  if (name)
  {
    text << ", array \"" << name << "\"";
  }
  else
  {
    text << ", attribute " << choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  return text.str();
}

std::array<std::string, 5> SurfaceInput::DescribeArrays() const
{
  std::array<std::string, 5> arrays;
  for (int index = RadiusArray; index <= InitialValueArray; ++index)
  {
    arrays[index] = this->DescribeArray(index);
  }
  return arrays;
}

ParticleArrays SurfaceInput::DescribeParticleArrays(bool all, bool velocities) const
{
  return { all, velocities ? this->DescribeArray(VelocityArray) : "" };
}

bool SurfaceInput::IsSplit(vtkInformation* information) const
{
  vtkDataObject* data = vtkDataObject::GetData(information);
  return vtkCompositeDataSet::SafeDownCast(data) && !Accepts(this->Port, data);
}

std::shared_ptr<InputShape> SurfaceInput::Read(
  vtkInformation* information, const ParticleArrays& kept, bool areShared) const
{
  vtkDataObject* object = vtkDataObject::GetData(information);
  const auto readOwn = [&]
  {
    const vtkSmartPointer<vtkDataSet> data = AsDataSet(object);
    return std::shared_ptr<InputShape>(MakeInputShape({ data, ArraysOf(*this, data), kept }));
  };
  if (this->Ranks.IsAlone())
  {
    return readOwn();
  }
  const OwnPiece own = HasNothing(object) ? OwnPiece() : this->MakeOwn(AsDataSet(object), kept);
  const std::string name = "The input of port " + std::to_string(this->Port);
  const AllPieces all = AgreeOnPieces(this->Ranks, own.Facts, name);
  if (all.Kind == PieceKind::Nothing && HasNothing(object)) // throws as on one process
  {
    return readOwn();
  }
  if (areShared && all.Kind == PieceKind::Particles)
  {
    return this->ReadOwned(own, all, kept, name);
  }
  std::shared_ptr<InputShape> whole = this->ReadWhole(own.Piece, kept, name);
  if (all.Kind == PieceKind::Particles) // for owned particles, ReadOwned sets the checksum
  {
    whole->Content = all.Content;
  }
  return whole;
}

// Returns the particles that this rank owns.
std::shared_ptr<InputShape> SurfaceInput::ReadOwned(const OwnPiece& own, const AllPieces& all,
  const ParticleArrays& kept, const std::string& name) const
{
  ParticleFrame particles =
    own.Shape ? dynamic_cast<ParticleShape&>(*own.Shape).ReleaseParticles() : ParticleFrame();
  particles.HasIds = this->IsArrayChosen(IdArray);
  const auto shape = std::make_shared<ParticleShape>(
    SendToOwners(this->Ranks, std::move(particles), all.PointsBefore, all.Points), kept,
    all.HaveCells);
  shape->Content = all.Content;
  auto owned = std::make_shared<OwnedPart>();
  owned->Ranks = this->Ranks;
  if (kept.All)
  {
    InputPiece copy = own.Piece; // the next step may overwrite the input's arrays
    if (copy.Data)
    {
      copy.Data.TakeReference(own.Piece.Data->NewInstance());
      copy.Data->DeepCopy(own.Piece.Data);
    }
    owned->ReadWhole = [this, copy, kept, name] { return this->ReadWhole(copy, kept, name); };
  }
  shape->Owned = owned;
  return shape;
}

std::unique_ptr<InputShape> SurfaceInput::ReadWhole(
  const InputPiece& piece, const ParticleArrays& kept, const std::string& name) const
{
  const vtkSmartPointer<vtkDataSet> whole = GatherWhole(this->Ranks, piece, name);
  return MakeInputShape({ whole, ArraysOf(*this, whole), kept });
}

void SurfaceInput::Check(vtkDataObject* data) const
{
  if (Accepts(this->Port, data))
  {
    const vtkSmartPointer<vtkDataSet> readable = AsDataSet(data);
    MakeInputShape({ readable, ArraysOf(*this, readable), {} });
  }
}

// Validates this rank's data before the exchange, so that the error names this rank.
SurfaceInput::OwnPiece SurfaceInput::MakeOwn(vtkDataSet* data, const ParticleArrays& kept) const
{
  OwnPiece own;
  own.Shape = MakeInputShape({ data, ArraysOf(*this, data), kept });
  own.Facts.Content = own.Shape->Content;
  if (data->GetNumberOfPoints() == 0)
  {
    return {};
  }
  own.Piece = this->MakePiece(data, kept);
  own.Facts.Kind = own.Piece.Kind;
  if (own.Piece.Kind == PieceKind::Particles)
  {
    vtkDataSet* points = own.Piece.Data;
    if (points->GetNumberOfPoints() != data->GetNumberOfPoints()) // ghosts were removed
    {
      own.Shape = MakeInputShape({ points, ArraysOf(*this, points), kept });
    }
    own.Facts.Points = static_cast<std::uint64_t>(points->GetNumberOfPoints());
    own.Facts.HasCells = points->GetNumberOfCells() > 0;
  }
  return own;
}

InputPiece SurfaceInput::MakePiece(vtkDataSet* data, const ParticleArrays& kept) const
{
  const ArraysOf chosen(*this, data);
  auto polyData = vtkPolyData::SafeDownCast(data);
  if (auto image = vtkImageData::SafeDownCast(data))
  {
    return MakeImagePiece(image, chosen.FindValues());
  }
  if (polyData && polyData->GetNumberOfPolys() + polyData->GetNumberOfStrips() > 0)
  {
    return MakeCellPiece(polyData, {});
  }
  if (polyData && polyData->GetNumberOfLines() > 0)
  {
    return MakeCellPiece(polyData, { false, { chosen.FindRadii(), chosen.FindStrengths() } });
  }
  PieceArrays arrays{ kept.All, { chosen.FindRadii(), chosen.FindIds(), chosen.FindStrengths() } };
  if (!kept.Velocities.empty())
  {
    arrays.Chosen.push_back(chosen.FindVelocities());
  }
  return MakeParticlePiece(vtkPointSet::SafeDownCast(data), arrays);
}

vtkAbstractArray* SurfaceInput::FindValues(vtkDataSet* image) const
{
  const int index = this->Port == Target ? ValueArray : InitialValueArray;
  vtkAbstractArray* chosen = this->FindArray(index, image);
  vtkAbstractArray* values = chosen ? chosen : image->GetPointData()->GetScalars();
  if (!values && !HasAttachedGrid(image->GetInformation()))
  {
    throw std::invalid_argument("The image of input port " + std::to_string(this->Port) +
      " has no active point scalars; choose a point array by SetInputArrayToProcess(" +
      std::to_string(index) +
      ", ...), or convert cell data to point data (vtkCellDataToPointData).");
  }
  return values;
}

// Returns null if no array is chosen.
vtkAbstractArray* SurfaceInput::FindArray(int index, vtkDataSet* data) const
{
  if (!this->IsArrayChosen(index))
  {
    return nullptr;
  }
  vtkInformation* choice = this->Filter->GetInputArrayInformation(index);
  const int association = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  vtkPointData* arrays = data->GetPointData();
  vtkAbstractArray* array = name
    ? arrays->GetAbstractArray(name)
    : arrays->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  const bool isOfPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
    association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS ||
    association == vtkDataObject::FIELD_ASSOCIATION_ROWS;
  if (!array || !isOfPoints)
  {
    throw std::invalid_argument("The input of port " + std::to_string(this->Port) +
      " has no point array as chosen by SetInputArrayToProcess(" + std::to_string(index) +
      ", ...): " + this->DescribeArray(index) + "; " + ListArrays(arrays) + ".");
  }
  return array;
}

}
