// Validates the sizes in the headers of an EXR file against the file size before OpenEXR allocates
// memory for them.

#ifndef EXRHeaderScan_h
#define EXRHeaderScan_h

#include "EXR/EXRStreams.h"

#include <ImfForward.h>

namespace activesurface
{

// Reads the headers by OpenEXR's attribute classes, then rewinds the stream. Throws std::exception
// if an attribute does not have its stated size, or a file of this size cannot contain the image.
void CheckEXRHeaders(EXRInput& input);

// Returns the unpacked size [bytes] of the lines, or of the tile, that OpenEXR packs at a time. A
// subsampled channel counts as if it had all samples.
double CountBytesOfChunk(const Imf::Header& header);

}

#endif
