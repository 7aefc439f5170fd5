// Arbitrary bytes as a saved state. A valid state is resumed, packed and unpacked.

#include "FuzzInput.h"

#include "NarrowBand.h"
#include "Simulation/StateFile.h"
#include "Surface/Skin.h"

#include <stdexcept>

using namespace activesurface;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const FuzzFile file(".vdb", data, size);
  try
  {
    const SavedState state = ReadState(file.GetName());
    const Skin skin(*state.Band);
    std::vector<double> points(3 * skin.GetNumberOfPoints());
    std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
    skin.Write(points.data(), nullptr, corners.data());
    NarrowBand::Unpack(state.Band->Pack());
  }
  catch (const std::runtime_error&)
  {
  }
  return 0;
}
