// Files of scan lines packed as ZIP or ZIPS: the format of OpenEXR's own writer, written by
// libdeflate, which packs about twice as fast as the zlib of OpenEXR 3.1 and smaller, and by all
// threads. The bytes do not depend on how many there are.

#ifndef EXRZip_h
#define EXRZip_h

#include "EXR/EXRPixels.h"
#include "EXR/EXRStreams.h"

#include <ImfHeader.h>

namespace activesurface
{

// Whether the header's compression is one of the two.
bool IsZipped(const Imf::Header& header);

// Writes all of a file. The channels are the header's, sorted by name, their rows from below;
// level: effort, 1 to 9. Throws FileError.
void WriteZipped(
  EXROutput& output, Imf::Header header, const std::vector<EXRSamples>& channels, int level);

}

#endif
