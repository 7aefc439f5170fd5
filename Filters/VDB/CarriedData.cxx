#include "CarriedData.h"

#include "StaticShutdown.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkObjectBase.h"

namespace activesurface
{

namespace
{

/** What an information object can hold. */
template <class Content>
class Parcel : public vtkObjectBase
{
public:
  vtkBaseTypeMacro(Parcel, vtkObjectBase);

  static void Put(vtkInformation* information, vtkInformationObjectBaseKey* key,
    const std::shared_ptr<const Content>& content)
  {
    if (!content)
    {
      information->Remove(key);
      return;
    }
    auto parcel = new Parcel;
    parcel->InitializeObjectBase();
    parcel->Inside = content;
    information->Set(key, parcel);
    parcel->Delete();
  }

  static std::shared_ptr<const Content> Take(
    vtkInformation* information, vtkInformationObjectBaseKey* key)
  {
    auto parcel = dynamic_cast<Parcel*>(information->Get(key));
    return parcel ? parcel->Inside : nullptr;
  }

protected:
  ~Parcel() override { ReleaseUnlessExiting(std::move(this->Inside)); }

private:
  std::shared_ptr<const Content> Inside;
};

/** They live as long as VTK's table of keys, as all keys do. */
vtkInformationObjectBaseKey* StateKey()
{
  static auto key = vtkInformationObjectBaseKey::MakeKey("STATE", "activesurface");
  return key;
}

vtkInformationObjectBaseKey* GridKey()
{
  static auto key = vtkInformationObjectBaseKey::MakeKey("GRID", "activesurface");
  return key;
}

}

void Carry(vtkInformation* information, const std::shared_ptr<const CarriedState>& state)
{
  Parcel<CarriedState>::Put(information, StateKey(), state);
}

std::shared_ptr<const CarriedState> GetCarriedState(vtkInformation* information)
{
  return Parcel<CarriedState>::Take(information, StateKey());
}

void Carry(vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid)
{
  Parcel<openvdb::FloatGrid>::Put(information, GridKey(), grid);
}

openvdb::FloatGrid::ConstPtr GetCarriedGrid(vtkInformation* information)
{
  return Parcel<openvdb::FloatGrid>::Take(information, GridKey());
}

}
