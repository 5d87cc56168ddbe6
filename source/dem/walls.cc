#include <graupel/dem/walls.h>

namespace graupel
{
  std::vector<Wall>
  vessel_walls(const Cylinder &cylinder)
  {
    const Triple<double> bottom, top{0., 0., cylinder.height};
    const Triple<double> up{0., 0., 1.};

    std::vector<Wall> walls(3);
    walls[lateral_wall] = {"wall", TubeWall{cylinder.diameter / 2.}};
    walls[bottom_wall]  = {"bottom", PlaneWall{bottom, -up}};
    walls[top_wall]     = {"top", PlaneWall{top, up}};
    return walls;
  }
} // namespace graupel
