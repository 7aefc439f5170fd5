#include "EXR/EXRPlan.h"

#include "Common/FileError.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>

namespace activesurface
{

namespace
{

constexpr std::size_t LongestChannelName = 255;

[[noreturn]] void Refuse(const std::string& sentence)
{
  throw FileError(vtkErrorCode::UserError, sentence);
}

bool IsInteger(const vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

// Returns true for colors: arrays named RGB or RGBA, and integers of 8 or 16 bits with 3 or 4
// components.
bool IsColor(vtkDataArray* array, const std::string& name)
{
  const int components = array->GetNumberOfComponents(), type = array->GetDataType();
  const bool picture = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  return ((name == "RGB" || name == "RGBA") && components >= 3 && components <= 4) ||
    (picture && components >= 3 && components <= 4);
}

EXRPixel ChooseType(vtkDataArray* array, const std::string& name, const EXRChoices& choices)
{
  const auto chosen = choices.Types.find(name);
  if (chosen != choices.Types.end())
  {
    return chosen->second;
  }
  if (!IsInteger(array))
  {
    return EXRPixel::FLOAT;
  }
  return IsColor(array, name) ? EXRPixel::HALF : EXRPixel::UINT;
}

std::vector<std::string> ComponentChannels(
  vtkDataArray* array, const std::string& name, bool picture)
{
  const int count = array->GetNumberOfComponents();
  const bool color = picture || IsColor(array, name);
  auto channels = NameChannels(picture ? "RGBA" : name, count, color);
  for (int i = 0; i < count && !picture && name != "RGB" && name != "RGBA"; ++i)
  {
    const char* component = array->GetComponentName(i);
    if (component && *component)
    {
      channels[static_cast<std::size_t>(i)] = name + "." + component;
    }
  }
  return channels;
}

EXRSource MakeSource(
  vtkDataArray* array, int component, const std::string& channel, const EXRChoices& choices)
{
  const std::string name = array->GetName();
  EXRSource source;
  source.Channel = channel;
  source.Array = array;
  source.Component = component;
  source.Type = ChooseType(array, name, choices);
  const bool color = IsColor(array, name);
  source.Normalized = color && IsInteger(array) && source.Type != EXRPixel::UINT;
  source.FromSRGB = choices.FromSRGB && color && component < 3 && source.Type != EXRPixel::UINT;
  if (channel.empty() || channel.size() > LongestChannelName)
  {
    Refuse("Channel \"" + channel + "\" needs a name of 1 to 255 letters.");
  }
  return source;
}

std::vector<EXRSource> PlanRequested(vtkPointData* data, const EXRChoices& choices)
{
  std::vector<EXRSource> sources;
  for (const EXRChannelRequest& request : choices.Channels)
  {
    vtkDataArray* array = data->GetArray(request.Array.c_str());
    if (!array || request.Component < 0 || request.Component >= array->GetNumberOfComponents())
    {
      Refuse("Channel " + request.Channel + " is to be component " +
        std::to_string(request.Component) + " of point array \"" + request.Array +
        "\", which the input does not have.");
    }
    sources.push_back(MakeSource(array, request.Component, request.Channel, choices));
  }
  return sources;
}

void PlanArray(
  vtkDataArray* array, bool scalars, const EXRChoices& choices, std::vector<EXRSource>& sources)
{
  // Arrays of other readers and of windows have names such as PNGImage and ImageScalars.
  const bool picture = scalars && array->GetName() && IsColor(array, array->GetName());
  if (!array->GetName() || !*array->GetName())
  {
    Refuse("A point array of the input has no name; name it, as its channels need one.");
  }
  const auto channels = ComponentChannels(array, array->GetName(), picture);
  for (std::size_t i = 0; i < channels.size(); ++i)
  {
    sources.push_back(MakeSource(array, static_cast<int>(i), channels[i], choices));
  }
}

}

std::vector<EXRSource> PlanChannels(vtkImageData* image, const EXRChoices& choices)
{
  vtkPointData* data = image->GetPointData();
  std::vector<EXRSource> sources = PlanRequested(data, choices);
  const auto isRequested = [&choices](const char* name)
  {
    return name &&
      std::any_of(choices.Channels.begin(), choices.Channels.end(),
        [name](const EXRChannelRequest& request) { return request.Array == name; });
  };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i); // null for texts
    if (array && !isRequested(array->GetName()))
    {
      PlanArray(array, array == data->GetScalars(), choices, sources);
    }
  }
  if (sources.empty())
  {
    Refuse("The input has no point array of numbers.");
  }
  std::sort(sources.begin(), sources.end(),
    [](const EXRSource& a, const EXRSource& b) { return a.Channel < b.Channel; });
  const auto twice = std::adjacent_find(sources.begin(), sources.end(),
    [](const EXRSource& a, const EXRSource& b) { return a.Channel == b.Channel; });
  if (twice != sources.end())
  {
    Refuse("Two components would become channel " + twice->Channel +
      "; AddChannel gives them other names.");
  }
  return sources;
}

}
