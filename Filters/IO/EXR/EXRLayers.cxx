#include "EXR/EXRLayers.h"

#include <algorithm>
#include <map>

namespace activesurface
{

namespace
{

struct SplitName
{
  std::string Layer, Component;
};

// Splits a name at the last dot. A name without a dot, or with the dot at either end, has no layer.
SplitName Split(const std::string& channel)
{
  const std::size_t dot = channel.rfind('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == channel.size())
  {
    return { "", channel };
  }
  return { channel.substr(0, dot), channel.substr(dot + 1) };
}

// Sets of components that form one array, in the array's order. Numbered components (0, 1, ...)
// form an array, too.
const std::vector<std::vector<std::string>> ComponentSets = { { "R", "G", "B", "A" },
  { "R", "G", "B" }, { "r", "g", "b", "a" }, { "r", "g", "b" }, { "X", "Y", "Z" },
  { "x", "y", "z" }, { "u", "v" }, { "U", "V" } };

// Channels of a layer that are not yet part of an array: type by component.
using Waiting = std::map<std::string, EXRPixel>;

bool Has(const Waiting& waiting, const std::vector<std::string>& components)
{
  const auto isInteger = [&waiting](const std::string& name)
  { return waiting.at(name) == EXRPixel::UINT; };
  for (const std::string& component : components)
  {
    if (waiting.count(component) == 0 || isInteger(component) != isInteger(components.front()))
    {
      return false;
    }
  }
  return true;
}

// Returns "0", "1" and so on: `count` texts, with leading zeros if there are more than ten.
std::vector<std::string> MakeNumbers(std::size_t count)
{
  const std::size_t digits = std::to_string(count - 1).size();
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string number = std::to_string(i);
    numbers.push_back(std::string(digits - number.size(), '0') + number);
  }
  return numbers;
}

std::string Join(const std::string& layer, const std::string& component)
{
  return layer.empty() ? component : layer + "." + component;
}

EXRLayer MakeLayer(
  Waiting& waiting, const std::string& layer, const std::vector<std::string>& names)
{
  EXRLayer layerOfNames;
  layerOfNames.Integer = waiting.at(names.front()) == EXRPixel::UINT;
  layerOfNames.Array = layer;
  if (layer.empty())
  {
    for (const std::string& name : names)
    {
      layerOfNames.Array += name; // RGBA
    }
  }
  for (const std::string& name : names)
  {
    layerOfNames.Channels.push_back(Join(layer, name));
    waiting.erase(name);
  }
  layerOfNames.Components = names;
  return layerOfNames;
}

void GroupLayer(const std::string& layer, Waiting waiting, std::vector<EXRLayer>& layers)
{
  for (const std::vector<std::string>& names : ComponentSets)
  {
    const bool picture = names.front() == "R";
    // Outside a layer, only R, G, B and A are joined: X, Y and Z become three arrays.
    if ((!layer.empty() || picture) && Has(waiting, names))
    {
      layers.push_back(MakeLayer(waiting, layer, names));
      break;
    }
  }
  if (!layer.empty() && waiting.size() > 1 && Has(waiting, MakeNumbers(waiting.size())))
  {
    layers.push_back(MakeLayer(waiting, layer, MakeNumbers(waiting.size())));
  }
  for (const auto& [name, type] : waiting)
  {
    const std::string channel = Join(layer, name);
    layers.push_back({ channel, { channel }, {}, type == EXRPixel::UINT });
  }
}

}

std::vector<EXRLayer> GroupChannels(const std::vector<EXRChannel>& channels)
{
  std::map<std::string, Waiting> byLayer; // the picture's own layer, "", comes first
  for (const EXRChannel& channel : channels)
  {
    const SplitName name = Split(channel.Name);
    byLayer[name.Layer].emplace(name.Component, channel.Type);
  }
  std::vector<EXRLayer> layers;
  for (const auto& [layer, waiting] : byLayer)
  {
    GroupLayer(layer, waiting, layers);
  }
  return layers;
}

std::vector<std::string> NameChannels(const std::string& array, int components, bool color)
{
  if (components == 1)
  {
    return { array };
  }
  std::vector<std::string> names;
  if (color || components == 4)
  {
    names = { "R", "G", "B", "A" };
  }
  else if (components == 3)
  {
    names = { "X", "Y", "Z" };
  }
  else if (components == 2)
  {
    names = { "u", "v" };
  }
  else
  {
    names = MakeNumbers(static_cast<std::size_t>(components));
  }
  names.resize(static_cast<std::size_t>(components));
  const bool picture = array == "RGBA" || array == "RGB";
  for (std::string& name : names)
  {
    name = Join(picture ? "" : array, name);
  }
  return names;
}

bool IsColorChannel(const std::string& channel)
{
  const std::string component = Split(channel).Component;
  const bool inLayer = component.size() != channel.size();
  return component == "R" || component == "G" || component == "B" || component == "A" ||
    (component == "Y" && !inLayer);
}

}
