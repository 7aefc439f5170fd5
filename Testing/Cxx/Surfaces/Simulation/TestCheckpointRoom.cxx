// Choice of the checkpoints to discard if the memory does not suffice for all.

#include "Support/AnalyticShapes.h"

#include "NarrowBand.h"
#include "Simulation/Trajectory.h"

#include <gtest/gtest.h>

#include <vector>

using namespace activesurface;

namespace TestCheckpointRoom
{

// The start is discarded last. Otherwise the state is discarded whose removal leaves the smallest
// gap; of several such states, the first one.
TEST(TestCheckpointRoom, TheStepsThatAreLeftAreFarApart)
{
  NarrowBand band(VoxelSizeOf(16));
  StartOn(band, MakeBall(CentreA, 0.5));
  Checkpoints states;
  states.SetLimits(1, 3 * band.Pack().size());
  for (int step = 0; step < 5; ++step)
  {
    states.Add(step, band);
  }
  std::vector<int> found;
  for (int step = 0; step < 5; ++step)
  {
    found.push_back(states.FindUpTo(step));
  }
  EXPECT_EQ(found, std::vector<int>({ 0, 0, 2, 2, 4 }));
}

}
