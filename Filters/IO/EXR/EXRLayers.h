// Maps names of EXR channels to names of VTK arrays by OpenEXR's layer convention: `N.X` is
// component X of layer N, and R, G, B, A are the picture itself.

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

// Channels that become the components of one array: all UINT, or none.
struct EXRLayer
{
  std::string Array;
  std::vector<std::string> Channels;
  std::vector<std::string> Components; // empty for an array of one component
  bool Integer = false;
};

struct EXRChannel
{
  std::string Name;
  EXRPixel Type = EXRPixel::HALF;
  int XSampling = 1, YSampling = 1;
};

// Groups channels into arrays; channels without a layer come first.
std::vector<EXRLayer> GroupChannels(const std::vector<EXRChannel>& channels);

// Names the channels of an array with `components` components; color: true if the components are
// colors.
std::vector<std::string> NameChannels(const std::string& array, int components, bool color);

// Returns true for channels that lossy compression may change: R, G, B and A of the picture or a
// layer, and Y of the picture.
bool IsColorChannel(const std::string& channel);

}

#endif
