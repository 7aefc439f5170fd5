// Skeletons, meshes and images as the target: what they are made of, and how they go from step to
// step.

#include "Check.h"
#include "PipelineTools.h"
#include "ShapeSource.h"

#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSampleFunction.h"
#include "vtkShortArray.h"
#include "vtkSkeletonPotential.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"

using namespace activesurface;

namespace
{

constexpr double VoxelSize = 0.05;
constexpr int Points = vtkDataObject::FIELD_ASSOCIATION_POINTS;

// The mesh is .0016 r = .016 h inside the ball; interpolation of distances is off by
// h^2 / 8 * 2 / r = .025 h, and chords of the skin by h^2 / 8 r = .013 h.
constexpr double MeshError = 0.06 * VoxelSize;

// Interpolation of squared distances is off by 3 * 2 * h^2 / 8, over 2 r = 1 .038 h; chords .013 h.
constexpr double ImageError = 0.06 * VoxelSize;

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOverInput()
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetParticleRadius(0.3);
  filter->SetAttraction(10.0);
  filter->SetVoxelSize(VoxelSize);
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(vtkDataSet* data)
{
  auto filter = MakeSkinOverInput();
  filter->SetInputData(data);
  return filter;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOver(ShapeSource* source)
{
  auto filter = MakeSkinOverInput();
  filter->SetInputConnection(source->GetOutputPort());
  return filter;
}

void IsABall(Check& check, vtkActiveImplicitSurface* filter, double radius, double tolerance,
  const std::string& name)
{
  const Radii radii = GetRadii(filter);
  check.Near(radii.Least, radius, tolerance, "least radius, " + name);
  check.Near(radii.Largest, radius, tolerance, "largest radius, " + name);
}

void UnsetBounds(vtkActiveImplicitSurface* filter)
{
  filter->SetModelBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0);
}

// The centre goes along x with .2 per unit of time; it is at rest until the first step.
void FollowsTheBall(Check& check, ShapeSource* source, double tolerance)
{
  auto filter = MakeSkinOver(source);
  for (const double time : { 0.0, 0.75, 1.0, 1.5, 2.0 })
  {
    filter->UpdateTimeStep(time);
    const auto bounds = GetSkinBounds(filter);
    const double lag = 0.2 / 10.0 * (1.0 - std::exp(-10.0 * time));
    check.Near(0.5 * (bounds[0] + bounds[1]), 0.2 * time - lag, tolerance,
      "centre at " + std::to_string(time));
  }
  check.Equal(source->GetExecutions(), "0 1 2 ", "times asked for");
}

void Refuses(Check& check, vtkActiveImplicitSurface* filter, const std::string& words)
{
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  check.Equal(Messages::Count(messages.Errors, words), 1, "errors with \"" + words + "\"");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
}

}

// The same arithmetic, by two ways; bounds and voxels are found alike.
void LinesActLikeASkeletonPotential(Check& check)
{
  vtkSmartPointer<vtkPolyData> lines = MakeLines();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("size");
  vtkNew<vtkDoubleArray> strengths;
  strengths->SetName("weight");
  for (const double size : { 0.2, 0.3, 0.4, 0.25 })
  {
    radii->InsertNextValue(size);
    strengths->InsertNextValue(1.2 - size);
  }
  lines->GetPointData()->AddArray(radii);
  lines->GetPointData()->AddArray(strengths);
  vtkNew<vtkSkeletonPotential> potential;
  potential->SetInput(lines);
  potential->SetRadius(0.3);
  auto input = MakeSkinOver(lines);
  auto function = MakeSkinOverInput();
  function->SetTargetFunction(potential);
  for (vtkActiveImplicitSurface* filter : { input.Get(), function.Get() })
  {
    filter->SetVoxelSize(0.0);
    UnsetBounds(filter);
  }
  check.True(GetBytesAt(input, 0.0) == GetBytesAt(function, 0.0), "one radius, at the start");
  check.True(GetBytesAt(input, 1.0) == GetBytesAt(function, 1.0), "one radius, at the end");

  input->SetInputArrayToProcess(0, 0, 0, Points, "size");
  input->SetInputArrayToProcess(2, 0, 0, Points, "weight");
  input->SetParticleKernelToCubicSpline();
  input->SetParticleThreshold(0.4);
  potential->SetRadiusArrayName("size");
  potential->SetStrengthArrayName("weight");
  potential->SetKernelToCubicSpline();
  potential->SetThreshold(0.4);
  check.Less(1000, GetBytesAt(function, 0.0).size(), "bytes");
  check.True(GetBytesAt(input, 0.0) == GetBytesAt(function, 0.0), "with arrays, at the start");
  check.True(GetBytesAt(input, 1.0) == GetBytesAt(function, 1.0), "with arrays, at the end");
}

void MeshOfABallGivesABall(Check& check)
{
  auto filter = MakeSkinOver(MakeBallMesh(0.5));
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.5, MeshError, "at the start");
  filter->UpdateTimeStep(1.0);
  IsABall(check, filter, 0.5, MeshError, "at the end");
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(MakeBallMesh(0.5));
  filter->SetInputConnection(stripper->GetOutputPort());
  filter->UpdateTimeStep(0.0);
  check.Less(0, stripper->GetOutput()->GetNumberOfStrips(), "strips");
  IsABall(check, filter, 0.5, MeshError, "of strips");
  filter->SetTargetIsoValue(0.1);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.6, MeshError, "at another level");
  check.Equal(messages.Warnings.size() + messages.Errors.size(), std::size_t(0), "messages");
}

void ImageOfABallGivesABall(Check& check)
{
  vtkNew<vtkSphere> ball;
  vtkNew<vtkSampleFunction> sampled;
  sampled->SetImplicitFunction(ball);
  sampled->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  sampled->SetSampleDimensions(41, 41, 41);
  auto filter = MakeSkinOverInput();
  filter->SetInputConnection(sampled->GetOutputPort());
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.5, ImageError, "at the start");
  filter->UpdateTimeStep(1.0);
  IsABall(check, filter, 0.5, ImageError, "at the end");

  // Rounding to integers is .5 of 1000, .01 h.
  vtkSmartPointer<vtkImageData> shorts = MakeBallImage(0.5);
  vtkDataArray* values = shorts->GetPointData()->GetScalars();
  vtkNew<vtkShortArray> rounded;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    rounded->InsertNextValue(static_cast<short>(std::lround(1000.0 * values->GetTuple1(i))));
  }
  shorts->GetPointData()->SetScalars(rounded);
  filter->SetInputData(shorts);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.5, ImageError + 0.01 * VoxelSize, "of short integers");
}

// A box of (2, 3, 4) pixels of half its size more, turned so that its x goes along -y.
void ImageIsWhereItsDirectionSays(Check& check)
{
  vtkSmartPointer<vtkImageData> image = MakeBallImage(0.5, 0.25);
  auto plain = MakeSkinOver(image);
  plain->UpdateTimeStep(0.0);
  check.Near(GetSkinBounds(plain)[1], 0.75, ImageError, "x max as it is");
  const double direction[9] = { 0, 1, 0, -1, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(direction);
  image->SetOrigin(0.1, 0.0, 0.0);
  auto turned = MakeSkinOver(image);
  turned->UpdateTimeStep(0.0);
  const auto bounds = GetSkinBounds(turned);
  check.Near(bounds[2], -0.75, ImageError, "y min when turned");
  check.Near(bounds[1], 0.6, ImageError, "x max when turned");
}

void InvertedImageHasItsInsideAbove(Check& check)
{
  vtkSmartPointer<vtkImageData> below = MakeBallImage(0.5);
  auto above = vtkSmartPointer<vtkImageData>::New();
  above->DeepCopy(below);
  vtkDataArray* values = above->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetTuple1(i, -values->GetTuple1(i));
  }
  auto plain = MakeSkinOver(below);
  auto inverted = MakeSkinOver(above);
  inverted->InvertTargetOn();
  check.True(GetBytesAt(plain, 0.5) == GetBytesAt(inverted, 0.5), "the same bytes");
  plain->SetTargetIsoValue(0.11);
  plain->UpdateTimeStep(0.0);
  IsABall(check, plain, 0.6, ImageError, "level .11");
  inverted->SetTargetIsoValue(-0.11);
  check.True(GetBytesAt(plain, 0.5) == GetBytesAt(inverted, 0.5), "the same bytes at a level");
  // Its inside is closed by the box of the image.
  plain->SetTargetIsoValue(0.0);
  plain->InvertTargetOn();
  UnsetBounds(plain);
  plain->UpdateTimeStep(0.0);
  check.Near(GetSkinBounds(plain)[1], 1.0, VoxelSize, "x max of the outside");
}

void ImagesArrayCanBeChosen(Check& check)
{
  vtkSmartPointer<vtkImageData> image = MakeBallImage(0.5);
  vtkNew<vtkDoubleArray> other;
  other->DeepCopy(MakeBallImage(0.7)->GetPointData()->GetScalars());
  other->SetName("other");
  image->GetPointData()->AddArray(other);
  auto filter = MakeSkinOver(image);
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.5, ImageError, "of the active scalars");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "other");
  filter->UpdateTimeStep(0.0);
  IsABall(check, filter, 0.7, ImageError, "of the other array");
  filter->SetInputArrayToProcess(3, 0, 0, Points, "none");
  Refuses(check, filter, "no point array as chosen by SetInputArrayToProcess(3");
}

// A lag of U / Attraction as for particles, within .12 h. The zero set of blended distances goes
// through the points of the straight way on the x axis.
void SkinFollowsAMovingMesh(Check& check)
{
  const auto source = MakeSource([](double t) { return MakeBallMesh(0.5, 0.2 * t); }, { 0, 1, 2 });
  FollowsTheBall(check, source, 0.12 * VoxelSize + MeshError);
}

// Blends of squared distances are exact; the source writes over its pixels.
void SkinFollowsAMovingImage(Check& check)
{
  const auto source = MakeSource([](double t) { return MakeBallImage(0.5, 0.2 * t); }, { 0, 1, 2 });
  FollowsTheBall(check, source, 0.12 * VoxelSize + ImageError);
}

// Half the way between two functions is their mean: of r^2 - .36 and r^2 - .16, r^2 - .26.
void StepsAreBlendedEvenly(Check& check)
{
  const auto shape = [](double t) { return MakeBallImage(t == 0.0 ? 0.6 : 0.4); };
  auto filter = MakeSkinOver(MakeSource(shape, { 0, 1 }));
  filter->SetAttraction(100.0);
  filter->UpdateTimeStep(0.5);
  // The radius falls by .2 per unit of time: a lag of .002, .04 h.
  IsABall(check, filter, std::sqrt(0.26), ImageError + 0.06 * VoxelSize, "half way");
}

void NumberOfParticlesMayChange(Check& check)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(
    [](double t)
    {
      const int count = t == 0.0 ? 3 : t == 1.0 ? 5 : 1;
      std::vector<Particle> particles;
      for (int i = 0; i < count; ++i)
      {
        particles.push_back({ 0.15 * i, 0.0, 0.0, i });
      }
      return particles;
    });
  source->SetSteps({ 0.0, 1.0, 2.0 });
  auto filter = MakeSkinOverInput();
  filter->SetInputConnection(source->GetOutputPort());
  Messages messages(filter);
  filter->UpdateTimeStep(1.5);
  check.Less(0, filter->GetOutput()->GetNumberOfPolys(), "triangles");
  filter->UpdateTimeStep(2.0);
  check.Less(0, filter->GetOutput()->GetNumberOfPolys(), "triangles");
  check.Equal(messages.Warnings.size() + messages.Errors.size(), std::size_t(0), "messages");
}

void KindThatChangesIsAnError(Check& check)
{
  const auto shape = [](double t)
  {
    vtkNew<vtkPolyData> points;
    points->SetPoints(MakeLines()->GetPoints());
    return t < 2.0 ? vtkSmartPointer<vtkPolyData>(points) : MakeBallMesh(0.5);
  };
  auto filter = MakeSkinOver(MakeSource(shape, { 0, 1, 2 }));
  const std::string before = GetBytesAt(filter, 1.0);
  Messages messages(filter);
  filter->UpdateTimeStep(2.0);
  check.Equal(Messages::Count(
                messages.Errors, "The target is a mesh at the time step 2, but particles before"),
    1, "errors");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  check.True(GetBytesAt(filter, 1.0) == before, "the same bytes before it, afterwards");
}

// Half the way to an empty step nothing is inside any more: from then on the skin shrinks at
// Attraction * TargetReach, .2 per unit of time, until half the way back. CFL: a skin at rest would
// take one substep.
void EmptyStepIsNoTarget(Check& check)
{
  const auto leaving = [](double t)
  { return t == 2.0 ? vtkSmartPointer<vtkPolyData>::New() : MakeBallMesh(0.5); };
  const auto steps = std::vector<double>{ 0, 1, 2, 3 };
  auto filter = MakeSkinOver(MakeSource(leaving, steps));
  filter->SetTargetReach(0.2);
  filter->SetAttraction(1.0);
  filter->SetCFL(0.1);
  Messages messages(filter);
  filter->UpdateTimeStep(1.0);
  IsABall(check, filter, 0.5, MeshError, "before");
  filter->UpdateTimeStep(2.0);
  check.Less(GetRadii(filter).Largest, 0.4, "radius when it is gone");
  const std::string gone = GetBytes(filter);
  filter->UpdateTimeStep(2.5);
  const double least = GetRadii(filter).Largest;
  check.Less(least, 0.3, "radius half the way back");
  filter->UpdateTimeStep(3.0);
  check.Less(least, GetRadii(filter).Least, "radius when it is back");
  check.Equal(messages.Warnings.size() + messages.Errors.size(), std::size_t(0), "messages");

  const auto losing = [](double t)
  {
    vtkSmartPointer<vtkPolyData> mesh = MakeBallMesh(0.5);
    mesh->SetPolys(t == 2.0 ? nullptr : mesh->GetPolys());
    return mesh;
  };
  auto other = MakeSkinOver(MakeSource(losing, steps));
  other->SetTargetReach(0.2);
  other->SetAttraction(1.0);
  other->SetCFL(0.1);
  check.True(GetBytesAt(other, 2.0) == gone, "a mesh without polygons is none");
}

void MeshThatAppearsLaterAttractsTheInitialShape(Check& check)
{
  const auto coming = [](double t)
  { return t == 0.0 ? vtkSmartPointer<vtkPolyData>::New() : MakeBallMesh(0.5); };
  auto filter = MakeSkinOver(MakeSource(coming, { 0, 1, 2 }));
  vtkNew<vtkSphere> start;
  start->SetRadius(0.6);
  filter->SetInitialFunction(start);
  filter->SetTargetReach(0.01);
  filter->UpdateTimeStep(2.0);
  IsABall(check, filter, 0.5, MeshError, "at the end");
}

void OpenMeshIsAWarningOrAShell(Check& check)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetThetaResolution(64);
  bowl->SetPhiResolution(32);
  bowl->SetEndPhi(90.0);
  auto filter = MakeSkinOverInput();
  filter->SetInputConnection(bowl->GetOutputPort());
  Messages messages(filter);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(0.2);
  filter->UpdateTimeStep(0.0);
  check.Equal(Messages::Count(messages.Warnings, "MeshThickness > 0 makes a shell"), 1, "warnings");
  check.Equal(Messages::Count(messages.Warnings, "open edges"), 1, "warnings that tell the edges");
  messages.Warnings.clear();
  filter->SetMeshThickness(0.2);
  filter->UpdateTimeStep(0.0);
  const Radii radii = GetRadii(filter);
  check.Near(radii.Largest, 0.6, MeshError, "outer radius of the shell");
  // At the rim it is round: no point is nearer to the centre than the inner wall.
  check.Near(radii.Least, 0.4, MeshError, "inner radius of the shell");
  check.Less(-0.15, GetSkinBounds(filter)[4], "z min of the shell");
  check.Equal(Messages::Count(messages.Warnings, "open edges"), 1, "warnings");
}

// With a quarter more for a mesh, and two voxels on each side of an image.
void BoundsComeFromTheTarget(Check& check)
{
  const auto spacing = [](vtkDataSet* data)
  {
    auto filter = MakeSkinOver(data);
    UnsetBounds(filter);
    filter->SetVoxelSize(0.0);
    filter->OutputPotentialOn();
    filter->Update();
    return filter->GetPotential()->GetSpacing()[0];
  };
  check.Near(spacing(MakeBallMesh(0.5, 7.0)), 1.25 / 64.0, 1e-9, "voxel size of a mesh");
  check.Near(spacing(MakeBallImage(0.5)), 2.0 / 60.0, 1e-9, "voxel size of an image");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "LinesActLikeASkeletonPotential", LinesActLikeASkeletonPotential },
      { "MeshOfABallGivesABall", MeshOfABallGivesABall },
      { "ImageOfABallGivesABall", ImageOfABallGivesABall },
      { "ImageIsWhereItsDirectionSays", ImageIsWhereItsDirectionSays },
      { "InvertedImageHasItsInsideAbove", InvertedImageHasItsInsideAbove },
      { "ImagesArrayCanBeChosen", ImagesArrayCanBeChosen },
      { "SkinFollowsAMovingMesh", SkinFollowsAMovingMesh },
      { "SkinFollowsAMovingImage", SkinFollowsAMovingImage },
      { "StepsAreBlendedEvenly", StepsAreBlendedEvenly },
      { "NumberOfParticlesMayChange", NumberOfParticlesMayChange },
      { "KindThatChangesIsAnError", KindThatChangesIsAnError },
      { "EmptyStepIsNoTarget", EmptyStepIsNoTarget },
      { "MeshThatAppearsLaterAttractsTheInitialShape",
        MeshThatAppearsLaterAttractsTheInitialShape },
      { "OpenMeshIsAWarningOrAShell", OpenMeshIsAWarningOrAShell },
      { "BoundsComeFromTheTarget", BoundsComeFromTheTarget } });
}
