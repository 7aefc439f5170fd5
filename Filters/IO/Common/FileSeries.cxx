#include "Common/FileSeries.h"

#include "Base/TimeSteps.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <regex>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::size_t MostDigits = 32;

std::string Pad(int number, std::size_t digits)
{
  const std::string text = std::to_string(number);
  digits = std::min(digits, MostDigits);
  return std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

}

std::string MakeFrameName(const std::string& pattern, int number, bool always)
{
  const std::size_t last = pattern.find_last_of('#');
  const std::size_t folder = pattern.find_last_of('/');
  if (last != std::string::npos && (folder == std::string::npos || folder < last))
  {
    const std::size_t before = pattern.find_last_not_of('#', last);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    return pattern.substr(0, first) + Pad(number, last + 1 - first) + pattern.substr(last + 1);
  }
  static const std::regex printed("%(0([0-9]{1,2}))?d");
  std::smatch found;
  if (std::regex_search(pattern, found, printed))
  {
    const std::size_t digits = found[2].matched ? std::stoul(found[2]) : 1;
    return found.prefix().str() + Pad(number, digits) + found.suffix().str();
  }
  if (!always)
  {
    return pattern;
  }
  const std::filesystem::path path(pattern);
  std::filesystem::path numbered = path;
  numbered.replace_filename(
    path.stem().string() + "." + Pad(number, 4) + path.extension().string());
  return numbered.string();
}

FileTimes::FileTimes(std::vector<double> stated)
  : Times(std::move(stated))
{
  const bool areFinite = std::all_of(
    this->Times.begin(), this->Times.end(), [](double time) { return std::isfinite(time); });
  const bool doAscend = std::adjacent_find(this->Times.begin(), this->Times.end(),
                          std::greater_equal<>()) == this->Times.end();
  if (!areFinite || !doAscend)
  {
    std::iota(this->Times.begin(), this->Times.end(), 0.0);
  }
}

int FileTimes::FindFile(vtkInformation* output) const
{
  const auto requested = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  return this->Times.empty() || !output->Has(requested)
    ? 0
    : FindStep(this->Times, output->Get(requested)).Step;
}

void FileTimes::Publish(vtkInformation* output) const
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  output->Remove(Pipeline::TIME_STEPS());
  output->Remove(Pipeline::TIME_RANGE());
  if (this->Times.size() > 1)
  {
    const double range[2] = { this->Times.front(), this->Times.back() };
    output->Set(Pipeline::TIME_STEPS(), this->Times.data(), static_cast<int>(this->Times.size()));
    output->Set(Pipeline::TIME_RANGE(), range, 2);
  }
}

void FileTimes::Mark(int file, vtkDataObject* data) const
{
  if (this->Times.size() > 1)
  {
    data->GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), this->Times[static_cast<std::size_t>(file)]);
  }
}

}
