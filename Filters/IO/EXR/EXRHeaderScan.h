// Validates the sizes in the headers of an EXR file against the file size before OpenEXR allocates
// memory. The scan knows the layout of headers, not the meaning of most attributes.

#ifndef EXRHeaderScan_h
#define EXRHeaderScan_h

#include "EXR/EXRStreams.h"

#include <ImfForward.h>

namespace activesurface
{

// Throws a FileError, with a sentence, unless the stream begins with valid EXR headers. Windows,
// tiles, tables and attributes have to fit into a file of this size. Rewinds the stream.
void CheckEXRHeaders(EXRInput& input);

// Bytes of the lines, or of the tile, that OpenEXR packs at a time; subsampled channels count whole.
double CountBytesOfChunk(const Imf::Header& header);

// Returns true if the stream begins with the first bytes of an EXR file.
bool IsEXR(std::istream& stream);

}

#endif
