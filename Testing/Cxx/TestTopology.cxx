// What becomes of bodies, voids and handles when the target has others: they split, merge, open and
// close by themselves, and appear only where the surface can get to.

#include "Check.h"
#include "SurfaceMeasures.h"

#include <string>

using namespace activesurface;

namespace
{
constexpr Point Origin = { 0.0, 0.0, 0.0 };

Shape MakeTwoBalls()
{
  return MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } });
}

// Twelve time constants after the start: e^-12 of the way is left, .0001 h.
void CheckTopology(
  Check& check, const Shape& start, const Shape& end, const Topology& expected, int n = 40)
{
  for (const double tension : { 0.0, 0.005 })
  {
    NarrowBand band(VoxelSizeOf(n));
    StartOn(band, start);
    ShapeTarget target(end);
    Motion motion;
    motion.Tension = tension;
    const AdvanceReport report = band.Advance(12.0, motion, target);
    const Mesh mesh = Polygonise(band);
    const Topology topology = GetTopology(mesh);
    const std::string name = tension > 0.0 ? "with tension" : "without tension";
    check.Near(topology.Components, expected.Components, 0, "bodies, " + name);
    check.Near(topology.Voids, expected.Voids, 0, "voids, " + name);
    check.Near(
      topology.EulerCharacteristic, expected.EulerCharacteristic, 0, "Euler number, " + name);
    check.Near(
      double(FindDefects(mesh).Edges), 0, 0, "edges that are not in two triangles, " + name);
    check.True(
      report.Vanished == (expected.Components == 0), "report tells if it vanished, " + name);
  }
}

void OneBallBecomesTwo(Check& check)
{
  CheckTopology(check, MakeBall(Origin, 0.5), MakeTwoBalls(), { 2, 0, 4 });
}

void TwoBallsBecomeOne(Check& check)
{
  CheckTopology(check, MakeTwoBalls(), MakeBall({ 0.01, 0.02, 0.0 }, 0.6), { 1, 0, 2 });
}

void BallBecomesATorus(Check& check)
{
  const Shape torus = MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.2);
  CheckTopology(check, MakeBall(Origin, 0.6), torus, { 1, 0, 0 });
}

void TorusBecomesABall(Check& check)
{
  const Shape torus = MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.2);
  CheckTopology(check, torus, MakeBall({ 0.01, 0.03, 0.02 }, 0.6), { 1, 0, 2 });
}

void OneOfTwoBallsVanishes(Check& check)
{
  CheckTopology(check, MakeTwoBalls(), MakeBall({ -0.4, 0.0, 0.0 }, 0.32), { 1, 0, 2 });
}

// No surface is there that could move to the void's.
void VoidOfTheTargetAloneIsNotMade(Check& check)
{
  CheckTopology(check, MakeBall(Origin, 0.6), MakeShell(0.7, 0.3), { 1, 0, 2 });
}

void VoidCloses(Check& check)
{
  CheckTopology(check, MakeShell(0.7, 0.3), MakeBall(Origin, 0.65), { 1, 0, 2 });
}

void VoidMoves(Check& check)
{
  CheckTopology(check, MakeShell(0.5, 0.4), MakeShell(0.7, 0.25), { 1, 1, 4 });
}

// It shrinks with the distance to the target's ball, and cannot jump there.
void BallApartFromItsTargetVanishes(Check& check)
{
  const Shape start = MakeBall({ -0.5, 0.0, 0.0 }, 0.25);
  CheckTopology(check, start, MakeBall({ 0.5, 0.0, 0.0 }, 0.25), { 0, 0, 0 });
}

// Under tension it is a near thing at n = 40: the lens that both balls share is .1 thick, two
// voxels, and with CFL .6 or less it vanishes first. From n = 48 on the time step does not decide.
void SmallOverlapIsEnoughToArrive(Check& check)
{
  const Shape start = MakeBall({ -0.2, 0.0, 0.0 }, 0.3);
  for (const int n : { 40, 64 })
  {
    CheckTopology(check, start, MakeBall({ 0.3, 0.0, 0.0 }, 0.3), { 1, 0, 2 }, n);
  }
}
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "OneBallBecomesTwo", OneBallBecomesTwo }, { "TwoBallsBecomeOne", TwoBallsBecomeOne },
      { "BallBecomesATorus", BallBecomesATorus }, { "TorusBecomesABall", TorusBecomesABall },
      { "OneOfTwoBallsVanishes", OneOfTwoBallsVanishes },
      { "VoidOfTheTargetAloneIsNotMade", VoidOfTheTargetAloneIsNotMade },
      { "VoidCloses", VoidCloses }, { "VoidMoves", VoidMoves },
      { "BallApartFromItsTargetVanishes", BallApartFromItsTargetVanishes },
      { "SmallOverlapIsEnoughToArrive", SmallOverlapIsEnoughToArrive } });
}
