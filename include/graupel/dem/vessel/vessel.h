// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_vessel_vessel_h
#define graupel_dem_vessel_vessel_h

#include <graupel/dem/vessel/section.h>
#include <graupel/dem/walls/walls.h>
#include <graupel/mesh/area_profile.h>
#include <graupel/mesh/vessel_mesh.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * The space in which particles can be: the cylinder between its ends, as far as all
   * planes leave it, inside of containers and outside of other closed surfaces. Surfaces
   * that are not closed take nothing away.
   *
   * A cylinder that nothing cuts has exactly the area of Cylinder::cross_section().
   * Sections that planes cut are exact; those with surfaces, and all volumes over which
   * the section changes, are good to 1e-4 at least. The same on every rank.
   */
  class Vessel
  {
  public:
    /** The cylinder with nothing in it. */
    explicit Vessel(const Cylinder &cylinder);
    /** The cylinder as @p spaces and @p bodies leave it. */
    Vessel(const Cylinder                &cylinder,
           const std::vector<HalfSpace>  &spaces,
           const std::vector<ClosedBody> &bodies = {});
    /** The cylinder as @p walls leave it where they are now. */
    Vessel(const Cylinder &cylinder, const std::vector<Wall> &walls);
    /** Also knows the fluid's space. */
    Vessel(const VesselMesh &mesh, const std::vector<Wall> &walls);

    /** The walls have moved, come or gone; cheap if they have not. */
    void follow(const std::vector<Wall> &walls);

    const Cylinder &
    cylinder() const
    {
      return tube;
    }

    /** Area of the section at @p z; 0 below the floor and above the ceiling [m^2]. */
    double cross_section(const double z) const;

    /** Of the space between two heights [m^3]. */
    double volume(const double lower, const double upper) const;

    /** How high over the floor @p solid [m^3] reaches if it is that @p part of the space
     * [m]; beyond the ceiling if it must. */
    double depth_of(const double solid, const double part = 1.) const;

    /** Where the space begins: z = 0 if nothing raises it [m]. */
    double floor() const;
    /** Where the space ends [m]. */
    double ceiling() const;

    /** Whether the section is the cylinder's whole circle at all heights. */
    bool is_tube() const;
    /** Whether the section is the same at all heights. */
    bool is_straight() const;

    /** Four times the area over the perimeter; none if the section changes over the
     * height, or surfaces make it [m]. */
    std::optional<double> hydraulic_diameter() const;

    /** Names of what particles meet, in the order of their walls; with their spaces
     * alone, none. */
    const std::vector<std::string> &
    walls() const
    {
      return wall_names;
    }

    /** Whether a wall is a floor: flat, level, and below the space. */
    bool is_floor(const unsigned int wall) const;

    /** Names of the boundaries of the fluid; none without a mesh. */
    const std::vector<std::string> &
    fluid_boundaries() const
    {
      return boundary_names;
    }

    /** Area of the fluid's section; that of the cylinder where it is not meshed from a
     * file [m^2]. */
    double fluid_cross_section(const double z) const;

    /**
     * Where fluid and particles have sections that differ by more than 1 %, for a mesh
     * from a file; empty: nowhere.
     */
    std::string difference() const;

  private:
    // What follows from spaces and bodies, found when it is first asked for.
    struct Shape
    {
      double      floor = 0., ceiling = 0.;
      double      area = 0.; // if it is the same everywhere
      AreaProfile profile;   // if not
    };

    void         take(const std::vector<Wall> &walls);
    double       area_at(const double z) const;
    const Shape &shape() const;
    Shape        find_shape() const;
    // The lowest height of the profile at which there is a section, or the highest.
    double              end_of_space(const AreaProfile &profile, const bool lower) const;
    std::vector<double> heights_of_steps(const double lower, const double upper) const;

    Cylinder                           tube;
    std::vector<HalfSpace>             spaces;
    std::vector<ClosedBody>            bodies;
    std::vector<double>                wall_places;
    std::vector<std::string>           wall_names, boundary_names;
    std::vector<bool>                  floors;
    std::shared_ptr<const MeshOutline> outline;

    mutable std::shared_ptr<const Shape> known_shape;
  };
} // namespace graupel

#endif
