#include "Pipeline/RankedRequest.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

template <class Value>
void Write(std::ostream& text, const Property& property, const Value& value)
{
  text << property.Name << ": " << static_cast<double>(value) << "\n";
}

void Write(std::ostream& text, const Property& property, const std::array<double, 6>& values)
{
  text << property.Name << ":";
  std::for_each(values.begin(), values.end(), [&text](double value) { text << " " << value; });
  text << "\n";
}

// Lists the values that must agree on all ranks, one on a line, with all bits of each number.
std::string DescribeRequest(
  const SurfaceProperties& properties, const SurfaceSettings& settings, const OutputRequest& output)
{
  std::ostringstream text;
  text << std::hexfloat << "the time: " << output.Time.Value << "\nthe output port: " << output.Port
       << "\n";
  const auto tell = [&text](const Property& property, const auto& value, auto&&)
  { Write(text, property, value); };
  ForEachProperty(settings, tell);
  ForEachOutputProperty(properties.Outputs, tell);
  ForEachLimit(properties.Limits, tell);
  const SurfaceInputs& inputs = settings.Inputs;
  text << "the time steps (TIME_STEPS of the input, or StartTime, TimeStepSize and "
          "NumberOfTimeSteps): "
       << inputs.TargetMoves << inputs.OnlyForward;
  std::for_each(
    inputs.Steps.begin(), inputs.Steps.end(), [&text](double step) { text << " " << step; });
  text << "\nthe presence of inputs and functions: " << !inputs.TargetFunction
       << !inputs.InitialFunction << !inputs.ObstacleFunction << inputs.HasInitialInput << "\n";
  for (const std::string& array : inputs.Arrays)
  {
    text << "the chosen arrays: " << array << "\n";
  }
  text << "the chosen arrays: " << output.Velocities << "\n";
  return text.str();
}

// Returns the name in the first line that differs.
std::string FindDifference(const std::string& one, const std::string& other)
{
  std::istringstream lines(one), others(other);
  std::string line, match;
  while (std::getline(lines, line) && std::getline(others, match) && line == match)
  {
  }
  return line.substr(0, line.find(':'));
}

std::string ToString(const Bytes& bytes)
{
  return { bytes.begin(), bytes.end() };
}

}

bool AgreeOnRequest(Agreement& ranks, const SurfaceProperties& properties,
  const SurfaceSimulation& simulation, const OutputRequest& output)
{
  const std::string request = DescribeRequest(properties, simulation.GetSettings(), output);
  const std::string own = request + '\0' + simulation.Describe();
  const std::vector<Bytes> all = ranks.Exchange({ own.begin(), own.end() });
  const std::string first = ToString(all.front());
  bool areAtOnePlace = true;
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    const std::string other = ToString(all[rank]);
    areAtOnePlace = areAtOnePlace && other == first;
    const std::string requests[2] = { first.substr(0, first.find('\0')),
      other.substr(0, other.find('\0')) };
    if (requests[0] != requests[1])
    {
      throw std::invalid_argument("The ranks make one skin together, but rank " +
        std::to_string(rank) + " has another value than rank 0 for " +
        FindDifference(requests[0], requests[1]) +
        "; set the same value on all ranks, or set Controller to none on each rank.");
    }
  }
  return areAtOnePlace;
}

void RunWithinMemory(
  const std::function<void()>& task, const std::function<void()>& startAnew, const char* sentence)
{
  try
  {
    task();
  }
  catch (const std::exception& error)
  {
    if (!IsOfMemory(error))
    {
      throw;
    }
    startAnew();
    throw std::runtime_error(sentence);
  }
}

}
