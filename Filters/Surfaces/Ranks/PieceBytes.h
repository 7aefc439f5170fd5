// A piece of an input as bytes, and back: nothing is rounded, numbers keep their types.

#ifndef PieceBytes_h
#define PieceBytes_h

#include "Communicator.h"

namespace activesurface
{

struct InputPiece;

// Throw std::runtime_error if it cannot be done.
Bytes PackPiece(const InputPiece& piece);
InputPiece UnpackPiece(const Bytes& bytes);

}

#endif
