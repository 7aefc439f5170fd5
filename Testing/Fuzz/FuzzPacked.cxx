// A packed band in which arbitrary bytes have been changed, or only arbitrary bytes.

#include "FuzzInput.h"

#include "Base/InitialFunction.h"
#include "NarrowBand.h"

#include <cmath>
#include <stdexcept>

using namespace activesurface;

namespace
{

std::string PackBall()
{
  NarrowBand band(0.25);
  InitialFunction ball;
  ball.Evaluate = [](std::size_t count, const double* points, double* values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = std::hypot(points[3 * i], points[3 * i + 1], points[3 * i + 2]) - 0.6;
    }
  };
  const double bounds[6] = { -1, 1, -1, 1, -1, 1 };
  band.Start(0.0, bounds, ball);
  return band.Pack();
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::string ball = PackBall();
  FuzzInput input(data, size);
  std::string bytes = ball;
  if (input.Below(4) == 0)
  {
    bytes.assign(reinterpret_cast<const char*>(data), size);
  }
  while (!input.IsOver())
  {
    const std::size_t place = input.Take<std::uint16_t>();
    bytes.resize(place % 64 == 0 ? place * bytes.size() / 65536 : bytes.size());
    if (!bytes.empty())
    {
      bytes[place % bytes.size()] = input.Take<char>();
    }
  }
  try
  {
    NarrowBand::Unpack(bytes)->Pack();
  }
  catch (const std::runtime_error&)
  {
  }
  catch (const std::invalid_argument&)
  {
    // The voxel size is invalid.
  }
  return 0;
}
