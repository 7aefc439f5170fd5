// What is wrong with a mesh: its defects, shells, and what vtkGridPotential refuses.

#include "Check.h"
#include "MeshShapes.h"

#include <cmath>
#include <functional>

// The shell's walls are spheres .1 within and without. Its distance has a kink at the mesh, which
// interpolation rounds off within two voxels; elsewhere it is as for the sphere, .01 at h = .05.
void OpenMeshesBecomeShells(Check& check)
{
  const auto half = MakeSphere(Radius, 24, 90.0);
  vtkNew<vtkGridPotential> potential;
  const Listener listener(potential);
  potential->SetInput(half);
  potential->SetVoxelSize(0.05);
  const std::string expected = "The mesh has defects: 24 open edges (of one polygon only).";
  check.Equal(std::string(potential->GetDefects()), expected, "defects");
  check.Equal(listener.Warnings, 1, "one warning");
  check.True(listener.Said("24 open edges"), "which names them");
  potential->SetMeshThickness(0.4);
  check.Near(ValueAt(potential, { 0.0, 0.0, 0.5 }), 0.1, 0.015, "below the shell");
  check.Near(ValueAt(potential, { 0.0, 0.0, 0.65 }), -0.05, 0.015, "in its lower half");
  check.Near(ValueAt(potential, { 0.0, 0.0, 0.95 }), -0.05, 0.015, "in its upper half");
  check.Near(ValueAt(potential, { 0.0, 0.0, 1.1 }), 0.1, 0.015, "above it");
  check.Less(0.2, ValueAt(potential, { 0.0, 0.0, -0.8 }), "where the other half would be");
  double bounds[6];
  check.True(potential->GetGridBounds(bounds), "bounds");
  check.Near(bounds[5], 1.0, 1e-12, "upper bound");
  check.Near(bounds[4], -0.2, 1e-12, "lower bound");
  check.Equal(listener.Warnings, 2, "one more warning, as it was read again");
  potential->SetWarnOfDefects(false);
  potential->Modified();
  potential->Build();
  check.Equal(listener.Warnings, 2, "none when it is turned off");
  potential->SetInput(MakeSphere(Radius, 24));
  check.Less(ValueAt(potential, { 0.0, 0.0, 0.0 }), -0.1, "a closed one stays a solid");
}

// Flat faces: exact but for the samples being floats.
void CubesThatShareAnEdgeAreASolid(Check& check)
{
  vtkNew<vtkGridPotential> potential;
  const Listener listener(potential);
  potential->SetInput(Append(MakeCube(-1.0, 0.0), MakeCube(0.0, 1.0)));
  potential->SetVoxelSize(0.05);
  check.Equal(std::string(potential->GetDefects()),
    "The mesh has defects: 1 edge of more than two polygons.", "defects");
  check.Equal(listener.Warnings, 1, "one warning");
  check.Near(ValueAt(potential, { -0.8, -0.5, 0.5 }), -0.2, 1e-6, "in one cube");
  check.Near(ValueAt(potential, { 0.8, 0.5, 0.5 }), -0.2, 1e-6, "in the other");
  check.Near(ValueAt(potential, { 0.8, -0.2, 0.5 }), 0.2, 1e-6, "beside them");
  potential->SetMeshThickness(0.1);
  check.Near(ValueAt(potential, { -0.8, -0.5, 0.5 }), -0.2, 1e-6, "closed: no shell");
}

// A point in five triangles or six is lost: they are left out, and leave a hole of as many edges.
void BrokenPolygonsAreLeftOut(Check& check)
{
  for (const double bad : { NaN, Infinity, 1e200 })
  {
    auto sphere = MakeSphere(Radius, 12);
    sphere->GetPoints()->SetPoint(40, 0.0, bad, 0.0);
    vtkNew<vtkGridPotential> potential;
    const Listener listener(potential);
    potential->SetInput(sphere);
    check.Equal(std::string(potential->GetDefects()),
      "The mesh has defects: 6 open edges (of one polygon only), 6 polygons with a point that is "
      "not finite or does not exist.",
      "defects");
    check.Equal(listener.Warnings, 1, "one warning");
    check.Equal(listener.Errors, 0, "no error");
    check.True(std::isfinite(ValueAt(potential, { 0.1, 0.2, 0.3 })), "a value");
    double bounds[6];
    check.True(potential->GetGridBounds(bounds) && bounds[3] <= Radius, "bounds");
  }
  const std::vector<Point> corners = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },
    { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };
  vtkNew<vtkGridPotential> potential;
  const Listener listener(potential);
  potential->SetInput(MakeMesh(corners,
    { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 }, { 1, 2, 4 }, { 1, 2, 9 }, { -1, 2, 3 },
      { 0, 1 }, {} }));
  potential->SetMeshThickness(0.1);
  check.Equal(std::string(potential->GetDefects()),
    "The mesh has defects: 2 polygons with a point that is not finite or does not exist, 3 "
    "polygons "
    "of fewer than three different points.",
    "defects");
  check.Less(ValueAt(potential, { 0.2, 0.2, 0.2 }), -0.1, "closed without them: a solid");
}

namespace
{
void ExpectError(Check& check, vtkGridPotential* potential, const std::string& words)
{
  const Listener listener(potential);
  check.Equal(ValueAt(potential, { 0.0, 0.0, 0.0 }), 1.0, words + ": outside everywhere");
  check.True(GradientAt(potential, { 0.0, 0.0, 0.0 }) == Point{ 0.0, 0.0, 0.0 }, "no gradient");
  check.Equal(listener.Errors, 1, words + ": one error");
  check.Equal(listener.Warnings, 0, words + ": no warning besides");
  check.True(listener.Said(words), potential->GetError());
}
}

void MeshesOfNoUseAreOneError(Check& check)
{
  const auto expect = [&check](vtkPolyData* mesh, const std::string& words)
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(mesh);
    ExpectError(check, potential, words);
  };
  expect(vtkNew<vtkPolyData>(), "has no polygons");
  expect(MakeMesh({ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 } }, {}), "has no polygons");
  expect(MakeMesh({ { 0.0, 0.0, NaN }, { 1.0, 0.0, 0.0 } }, { { 0, 1, 1 } }), "no polygon of use");
  vtkNew<vtkPolyData> noPoints;
  noPoints->SetPolys(MakeMesh({}, { { 0, 1, 2 } })->GetPolys());
  expect(noPoints, "no polygon of use");
}

void LatticesTooLargeAreRefused(Check& check)
{
  const auto expect = [&check](
                        const std::string& words, const std::function<void(vtkGridPotential*)>& set)
  {
    vtkNew<vtkGridPotential> potential;
    potential->SetInput(MakeSphere(Radius, 20));
    set(potential);
    ExpectError(check, potential, words);
  };
  const std::string tooMany = "MaximumNumberOfVoxels";
  expect(tooMany, [](vtkGridPotential* p) { p->SetVoxelSize(1e-4); });
  expect("10^9 voxels", [](vtkGridPotential* p) { p->SetVoxelSize(1e-12); });
  expect("10^9 voxels", [](vtkGridPotential* p) { p->SetVoxelSize(1e-320); });
  expect("VoxelSize must be", [](vtkGridPotential* p) { p->SetVoxelSize(NaN); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetReach(1e6); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetReach(Infinity); });
  expect("Reach must be", [](vtkGridPotential* p) { p->SetReach(NaN); });
  expect("MeshThickness must be", [](vtkGridPotential* p) { p->SetMeshThickness(NaN); });
  expect(tooMany, [](vtkGridPotential* p) { p->SetMaximumNumberOfVoxels(100000); });
  // A sliver of no area, as long as 1e8 voxels.
  expect(tooMany,
    [](vtkGridPotential* p)
    {
      p->SetInput(
        MakeMesh({ { 0.0, 0.0, 0.0 }, { 1e8, 0.0, 0.0 }, { 1.0, 0.0, 0.0 } }, { { 0, 1, 2 } }));
      p->SetVoxelSize(1.0);
      p->SetReach(3.0);
    });
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    {
      { "OpenMeshesBecomeShells", OpenMeshesBecomeShells },
      { "CubesThatShareAnEdgeAreASolid", CubesThatShareAnEdgeAreASolid },
      { "BrokenPolygonsAreLeftOut", BrokenPolygonsAreLeftOut },
      { "MeshesOfNoUseAreOneError", MeshesOfNoUseAreOneError },
      { "LatticesTooLargeAreRefused", LatticesTooLargeAreRefused },
    });
}
