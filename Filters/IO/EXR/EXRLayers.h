// How channels of EXR files and arrays of VTK bear each other's names: OpenEXR's convention of
// layers, in which `N.X` is component X of layer N, and R, G, B, A are the picture itself.

#ifndef EXRLayers_h
#define EXRLayers_h

#include <string>
#include <vector>

namespace activesurface
{

enum class EXRPixel
{
  UINT = 0,
  HALF = 1,
  FLOAT = 2
};

// Channels that become the components of one array. All are UINT, or none is.
struct EXRLayer
{
  std::string Array;
  std::vector<std::string> Channels;
  std::vector<std::string> Components; // what follows the dot; empty for an array of one component
  bool Integer = false;
};

struct EXRNamedPixel
{
  std::string Name;
  EXRPixel Type;
};

// Groups channels, in the order in which arrays are to be shown: the picture first.
std::vector<EXRLayer> GroupChannels(const std::vector<EXRNamedPixel>& channels);

// The channels of an array with so many components; `color` where it holds colors.
std::vector<std::string> NameChannels(const std::string& array, int components, bool color);

// Whether a channel may be packed with loss: R, G, B, A or Y, of the picture or of a layer.
bool IsColorChannel(const std::string& channel);

}

#endif
