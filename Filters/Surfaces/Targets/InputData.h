/**
 * What comes through an input port, to make a shape of: a data set, the arrays that were chosen of
 * it, and which arrays of particles are to be kept besides.
 */
#ifndef InputData_h
#define InputData_h

#include <string>

class vtkAbstractArray;
class vtkDataSet;

namespace activesurface
{

/**
 * The point arrays that a user has chosen, by what they are for. Each is null if none was chosen,
 * and throws std::invalid_argument if the one that was chosen is missing.
 */
class ChosenArrays
{
public:
  virtual ~ChosenArrays() = default;

  virtual vtkAbstractArray* FindRadii() const = 0;
  virtual vtkAbstractArray* FindIds() const = 0;
  virtual vtkAbstractArray* FindStrengths() const = 0;
  virtual vtkAbstractArray* FindVelocities() const = 0;

  /**
   * The chosen values of an image, else its active scalars. Null for an image that has a grid
   * attached in place of them; throws if it has neither.
   */
  virtual vtkAbstractArray* FindValues() const = 0;
};

/** Which arrays of particles are kept, besides radii, ids and strengths. */
struct ParticleArrays
{
  bool All = false;       //< copies of all of them, for the skin
  std::string Velocities; //< a description of the chosen array; empty: no velocities

  bool operator==(const ParticleArrays& other) const
  {
    return this->All == other.All && this->Velocities == other.Velocities;
  }
};

struct InputData
{
  vtkDataSet* Data;
  const ChosenArrays& Chosen;
  const ParticleArrays& Kept;
};

}

#endif
