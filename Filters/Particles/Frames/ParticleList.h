// A compact list of particles. Coordinates are stored in single precision if that is exact. A
// radius or strength common to all particles is stored once.

#ifndef ParticleList_h
#define ParticleList_h

#include "Index/Skeleton.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace activesurface
{

class ParticleList
{
public:
  class Iterator
  {
  public:
    Iterator(const ParticleList& list, std::size_t at)
      : List(list)
      , At(at)
    {
    }
    SkeletonVertex operator*() const { return this->List[this->At]; }
    Iterator& operator++()
    {
      ++this->At;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return this->At != other.At; }

  private:
    const ParticleList& List;
    std::size_t At;
  };

  // NOLINTBEGIN(readability-identifier-naming): the names are the standard library's
  std::size_t size() const { return this->Single.size() + this->Double.size(); }
  bool empty() const { return this->size() == 0; }
  Iterator begin() const { return { *this, 0 }; }
  Iterator end() const { return { *this, this->size() }; }
  // NOLINTEND(readability-identifier-naming)

  SkeletonVertex operator[](std::size_t i) const
  {
    SkeletonVertex particle;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      particle.Position[axis] =
        this->IsSingle ? static_cast<double>(this->Single[i][axis]) : this->Double[i][axis];
    }
    particle.Radius = this->Radii.Get(i);
    particle.Strength = std::min(this->Strengths.Get(i), this->MostStrength);
    return particle;
  }

  double GetGivenStrength(std::size_t i) const { return this->Strengths.Get(i); }

  // Reserves capacity in an empty list. isSingle: the coordinates are exact in single precision.
  void Reserve(std::size_t count, bool isSingle)
  {
    this->IsSingle = isSingle;
    isSingle ? this->Single.reserve(count) : this->Double.reserve(count);
  }

  void Add(const SkeletonVertex& particle)
  {
    const auto& x = particle.Position;
    this->Radii.Add(particle.Radius, this->size());
    this->Strengths.Add(particle.Strength, this->size());
    if (this->IsSingle)
    {
      this->Single.push_back(
        { static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2]) });
    }
    else
    {
      this->Double.push_back({ x[0], x[1], x[2] });
    }
  }

  double GetLargestRadius() const { return this->empty() ? 0.0 : this->Radii.GetLargest(); }

  bool AreSingle() const { return this->IsSingle; }
  // Returns true if a strength is not 1.
  bool HaveStrengths() const
  {
    return !this->Strengths.Each.empty() || this->Strengths.Common != 1.0;
  }

  // Makes operator[] return `most` for strengths above. Returns true if there are any.
  bool LimitStrengths(double most)
  {
    this->MostStrength = most;
    return !this->empty() && this->Strengths.GetLargest() > most;
  }

  // Radius of all particles; valid only if the radii are equal.
  double GetCommonRadius() const { return this->Radii.Common; }

  void SetRadius(double radius) { this->Radii = { radius, {} }; }
  void ScaleRadii(double factor)
  {
    this->Radii.Common *= factor;
    for (double& radius : this->Radii.Each)
    {
      radius *= factor;
    }
  }

  void MoveBy(const double offset[3])
  {
    this->MakeDouble();
    for (std::array<double, 3>& place : this->Double)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] += offset[axis];
      }
    }
  }

  // Reorders the list: the particle order[i] gets the index i.
  void Permute(const std::vector<std::size_t>& order)
  {
    PermuteList(order, this->Single);
    PermuteList(order, this->Double);
    PermuteList(order, this->Radii.Each);
    PermuteList(order, this->Strengths.Each);
  }

  template <class Value>
  static void PermuteList(const std::vector<std::size_t>& order, std::vector<Value>& values)
  {
    if (values.empty())
    {
      return;
    }
    std::vector<Value> sorted;
    sorted.reserve(values.size());
    for (const std::size_t place : order)
    {
      sorted.push_back(values[place]);
    }
    values.swap(sorted);
  }

private:
  struct Column
  {
    double Common = 1.0;
    std::vector<double> Each; // empty if all values are Common

    double Get(std::size_t i) const { return this->Each.empty() ? this->Common : this->Each[i]; }
    double GetLargest() const
    {
      return this->Each.empty() ? this->Common
                                : *std::max_element(this->Each.begin(), this->Each.end());
    }
    // count: number of values so far.
    void Add(double value, std::size_t count)
    {
      if (count == 0)
      {
        this->Common = value;
      }
      if (this->Each.empty() && value != this->Common)
      {
        this->Each.assign(count, this->Common);
      }
      if (!this->Each.empty())
      {
        this->Each.push_back(value);
      }
    }
  };

  void MakeDouble()
  {
    this->Double.reserve(this->size());
    for (const std::array<float, 3>& place : this->Single)
    {
      this->Double.push_back({ place[0], place[1], place[2] });
    }
    this->Single = {};
    this->IsSingle = false;
  }

  bool IsSingle = false;
  // Coordinates; at least one of these two lists is empty.
  std::vector<std::array<float, 3>> Single;
  std::vector<std::array<double, 3>> Double;
  Column Radii, Strengths;
  double MostStrength = std::numeric_limits<double>::infinity();
};

}

#endif
