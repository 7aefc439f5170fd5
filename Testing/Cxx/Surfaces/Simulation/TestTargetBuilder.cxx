// Kinds of input: each data set has one kind. A separate target attracts like the target in use.

#include "Shapes/MeshShapes.h"
#include "Simulation/TargetBuilder.h"
#include "Support/Throws.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"

#include "vtkFloatArray.h"
#include "vtkRectilinearGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestTargetBuilder
{

namespace
{

class NoArrays : public ChosenArrays
{
public:
  explicit NoArrays(vtkDataSet* data)
    : Data(data)
  {
  }

  vtkAbstractArray* FindRadii() const override { return nullptr; }
  vtkAbstractArray* FindIds() const override { return nullptr; }
  vtkAbstractArray* FindStrengths() const override { return nullptr; }
  vtkAbstractArray* FindVelocities() const override { return nullptr; }
  vtkAbstractArray* FindValues() const override { return this->Data->GetPointData()->GetScalars(); }

private:
  vtkDataSet* Data;
};

std::unique_ptr<InputShape> Read(vtkDataSet* data)
{
  return MakeInputShape({ data, NoArrays(data), ParticleArrays() });
}

// Points in a row, all or none joined by lines; the first one is at (from, from, from).
vtkSmartPointer<vtkPolyData> MakeRow(int count, double from, bool joined)
{
  auto row = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->InsertNextPoint(from + 0.25 * i, from, from);
    const vtkIdType segment[] = { i - 1, i };
    if (joined && i > 0)
    {
      lines->InsertNextCell(2, segment);
    }
  }
  row->SetPoints(points);
  row->SetLines(lines);
  return row;
}

// Distances to the origin, less the radius.
vtkSmartPointer<vtkImageData> MakeBallImage(double radius)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(9, 9, 9);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(0.25, 0.25, 0.25);
  vtkNew<vtkFloatArray> values;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    values->InsertNextValue(static_cast<float>(std::hypot(x[0], x[1], x[2]) - radius));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

// A builder with two steps and a domain.
struct Steps
{
  Steps(vtkDataSet* first, vtkDataSet* second)
  {
    this->Settings.Inputs.TargetMoves = true;
    this->Settings.Inputs.Steps = { 0.0, 1.0 };
    this->Settings.IsoValue = 0.125;
    this->Settings.VoxelSize = 0.0625;
    this->Settings.Bounds = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
    this->Builder.FindDomain();
    this->Builder.Add(0, Read(first));
    this->Builder.Add(1, Read(second));
    this->Builder.StartTarget();
  }

  SurfaceSettings Settings;
  Warnings Messages;
  TargetBuilder Builder{ this->Settings, this->Messages };
};

// Values and slopes at points all over the domain.
std::vector<double> Sample(const PotentialTarget& target)
{
  constexpr std::size_t count = 500;
  Random random(1);
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point x = random.In(-1.0, 1.0);
    points.insert(points.end(), x.begin(), x.end());
  }
  std::vector<double> samples(2 * count);
  target.Evaluate(count, points.data(), { samples.data(), samples.data() + count });
  return samples;
}

void AttractsAlike(vtkDataSet* first, vtkDataSet* second, const std::string& name)
{
  Steps steps(first, second);
  MovingTarget& used = *steps.Builder.GetMovingTarget();
  used.MoveAlong(0, 0.0, 1.0);
  used.MoveTo(0.375);
  const std::vector<double> before = Sample(used);
  const auto own = steps.Builder.MakeTargetAt(0, 0.0, 1.0);
  own->MoveTo(0.375);
  EXPECT_TRUE(AreSameBytes(Sample(*own), before)) << name << ": the same bytes";
  own->MoveTo(1.0);
  EXPECT_FALSE(AreSameBytes(Sample(*own), before)) << name << ": its own path changes something";
  EXPECT_TRUE(AreSameBytes(Sample(used), before)) << name << ": the one in use has not moved";
}

}

TEST(TestTargetBuilder, EachDataSetIsOfOneKind)
{
  const auto name = [](vtkDataSet* data) { return std::string(Read(data)->GetName()); };
  EXPECT_EQ(name(vtkNew<vtkPolyData>()), "nothing") << "no points";
  EXPECT_EQ(name(MakeRow(3, 0.0, false)), "particles") << "only points";
  EXPECT_EQ(name(MakeRow(3, 0.0, true)), "a skeleton of lines") << "lines";
  EXPECT_EQ(name(MakeSphere(0.5, 8)), "a mesh") << "polygons";
  EXPECT_EQ(name(MakeBallImage(0.5)), "an image") << "an image";
  EXPECT_TRUE(Throws<std::invalid_argument>(
    [&] { Read(Append(MakeRow(3, 0.0, true), MakeSphere(1, 8))); }, "both polygons and lines"))
    << "lines and polygons";
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(1, 1, 1);
  EXPECT_TRUE(Throws<std::invalid_argument>([&] { Read(grid); }, "neither points nor an image"))
    << "another lattice";
}

TEST(TestTargetBuilder, KindsDoNotMix)
{
  const auto mix = [](vtkDataSet* first, vtkDataSet* second) { Steps(first, second); };
  EXPECT_TRUE(Throws<std::invalid_argument>([&] { mix(MakeSphere(0.5, 8), MakeRow(3, 0.0, true)); },
    "The target is a skeleton of lines at the time step 1, but a mesh before;"))
    << "mesh, skeleton";
  EXPECT_TRUE(
    Throws<std::invalid_argument>([&] { mix(MakeRow(3, 0.0, false), MakeSphere(0.5, 8)); },
      "The target is a mesh at the time step 1, but particles before;"))
    << "particles, mesh";
  Steps lost(MakeSphere(0.5, 8), MakeRow(3, 0.0, false));
  EXPECT_TRUE(!lost.Builder.GetFrames().Find(1)->HasPoints())
    << "a mesh without polygons is nothing";
  Steps born(vtkNew<vtkPolyData>(), MakeRow(3, 0.0, false));
  EXPECT_TRUE(born.Builder.HasParticles(0, 1)) << "particles after nothing";
  EXPECT_TRUE(!born.Builder.HasParticles(0, 0)) << "nothing, whatever comes later";
}

TEST(TestTargetBuilder, ATargetOfItsOwnAttractsAlike)
{
  AttractsAlike(MakeRow(4, -0.5, false), MakeRow(6, 0.0, false), "particles, born");
  AttractsAlike(MakeRow(4, -0.5, true), MakeRow(6, 0.0, true), "skeletons");
  AttractsAlike(MakeSphere(0.5, 16), MakeSphere(0.75, 16), "meshes");
  AttractsAlike(MakeBallImage(0.5), MakeBallImage(0.75), "images");
  AttractsAlike(MakeSphere(0.5, 16), vtkNew<vtkPolyData>(), "a mesh that vanishes");
}

}
