extern "C" {
#include "mesh_connect.h"
}
#include "cancel.hpp"
#include "failure.hpp"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>
#include <xxhash.h>

namespace
{

struct owned_connection : mesh_connection {
    std::vector<std::int32_t> neighbours;
};

/* The soup as the caller gave it. */
struct soup_view {
    std::uint32_t vertex_count;
    const double (*position)[3];
    std::uint32_t face_count;
    const std::uint32_t *first, *corner;
};

void check(const soup_view &soup)
{
    if (soup.face_count && soup.first[0])
        throw failure("the first face does not begin at corner 0");
    for (std::uint32_t i = 0; i < soup.face_count; i++) {
        if (soup.first[i + 1] < soup.first[i])
            throw failure("face " + std::to_string(i) + ": its corners end before they begin");
        for (std::uint32_t c = soup.first[i]; c < soup.first[i + 1]; c++)
            if (soup.corner[c] >= soup.vertex_count)
                throw failure("face " + std::to_string(i) + ": vertex " +
                              std::to_string(soup.corner[c]) + " of " +
                              std::to_string(soup.vertex_count));
    }
}

/* Finds, among the items seen so far, the first one that is equal. */
class first_equal
{
  public:
    explicit first_equal(std::size_t item_count)
    {
        std::size_t size = 16;

        while (size < 2 * item_count) size *= 2;
        slot_.assign(size, empty);
    }

    /* Returns `item` itself where it is the first of its kind. */
    template <typename Equal>
    std::uint32_t find_or_add(std::uint32_t item, std::uint64_t hash, const Equal &is_equal)
    {
        std::size_t at = hash & (slot_.size() - 1);

        while (slot_[at] != empty && !is_equal(slot_[at], item)) at = (at + 1) & (slot_.size() - 1);
        if (slot_[at] == empty) slot_[at] = item;
        return slot_[at];
    }

  private:
    static constexpr std::uint32_t empty = UINT32_MAX;
    std::vector<std::uint32_t> slot_;
};

/* For every vertex the first one at the same place. */
std::vector<std::uint32_t> welded(const soup_view &soup)
{
    std::vector<std::uint32_t> first(soup.vertex_count);
    first_equal seen(soup.vertex_count);
    const auto bits = [&soup](std::uint32_t vertex) {
        std::array<std::uint64_t, 3> word;
        for (int axis = 0; axis < 3; axis++) {
            const double x = soup.position[vertex][axis] + 0.0; /* makes -0 into 0 */
            std::memcpy(&word[static_cast<std::size_t>(axis)], &x, sizeof x);
        }
        return word;
    };

    for (std::uint32_t i = 0; i < soup.vertex_count; i++) {
        cancel_check();
        const auto word = bits(i);
        const std::uint64_t hash = XXH3_64bits(word.data(), sizeof word);
        first[i] = seen.find_or_add(
            i, hash, [&](std::uint32_t a, std::uint32_t) { return bits(a) == word; });
    }
    return first;
}

/* The vertices of every face, each once and sorted. */
struct vertex_sets {
    std::vector<std::uint32_t> begin{0}, vertex;

    std::size_t size(std::uint32_t face) const
    {
        return begin[face + 1] - begin[face];
    }
    bool equal(std::uint32_t a, std::uint32_t b) const
    {
        return size(a) == size(b) &&
               std::equal(&vertex[begin[a]], &vertex[begin[a]] + size(a), &vertex[begin[b]]);
    }
};

bool is_finite(const soup_view &soup, std::uint32_t face)
{
    for (std::uint32_t c = soup.first[face]; c < soup.first[face + 1]; c++)
        for (const double x : soup.position[soup.corner[c]])
            if (!std::isfinite(x)) return false;
    return true;
}

struct face_area {
    double normal[3]; /* twice the area long */
    bool is_flat;     /* no area beyond what rounding of the coordinates can make */
};

face_area area_of(const soup_view &soup, std::uint32_t face)
{
    const std::uint32_t *corner = soup.corner + soup.first[face];
    const std::uint32_t count = soup.first[face + 1] - soup.first[face];
    const double *origin = soup.position[corner[0]];
    face_area area{};
    double *const normal = area.normal, largest = 0, reach = 0;

    for (std::uint32_t k = 0; k < count; k++) {
        const double *p = soup.position[corner[k]], *q = soup.position[corner[(k + 1) % count]];
        for (int axis = 0; axis < 3; axis++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            normal[axis] +=
                (p[u] - origin[u]) * (q[v] - origin[v]) - (p[v] - origin[v]) * (q[u] - origin[u]);
            largest = std::fmax(largest, std::fabs(p[axis]));
            reach = std::fmax(reach, std::fabs(p[axis] - origin[axis]));
        }
    }
    area.is_flat = std::hypot(normal[0], normal[1], normal[2]) <= 4 * DBL_EPSILON * largest * reach;
    return area;
}

bool faces_alike(const face_area &a, const face_area &b)
{
    return a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2] > 0;
}

class connector
{
  public:
    connector(const soup_view &soup, owned_connection &result)
        : soup_(soup), result_(result), vertex_(welded(soup))
    {
    }

    void run()
    {
        const std::vector<bool> is_sound = sound_faces();

        handle_.resize(soup_.vertex_count);
        for (std::uint32_t i = 0; i < soup_.face_count; i++)
            if (is_sound[i]) add(i);
        for (std::uint32_t handle = 0; handle < face_.size(); handle++) look_around(handle);
    }

  private:
    using poly_mesh = OpenMesh::PolyMesh_ArrayKernelT<>;

    std::uint32_t vertex(std::uint32_t face, std::uint32_t k) const
    {
        return vertex_[soup_.corner[soup_.first[face] + k]];
    }

    std::uint32_t corner_count(std::uint32_t face) const
    {
        return soup_.first[face + 1] - soup_.first[face];
    }

    vertex_sets sets() const
    {
        vertex_sets sets;

        for (std::uint32_t i = 0; i < soup_.face_count; i++) {
            cancel_check();
            for (std::uint32_t k = 0; k < corner_count(i); k++) sets.vertex.push_back(vertex(i, k));
            const auto begin = sets.vertex.begin() + sets.begin.back();
            std::sort(begin, sets.vertex.end());
            sets.vertex.erase(std::unique(begin, sets.vertex.end()), sets.vertex.end());
            sets.begin.push_back(static_cast<std::uint32_t>(sets.vertex.size()));
        }
        return sets;
    }

    /* Counts the faces that are no neighbours to anyone, whatever their surroundings. */
    std::vector<bool> sound_faces()
    {
        const vertex_sets set = sets();
        std::vector<bool> is_sound(soup_.face_count);
        first_equal seen(soup_.face_count), seen_facing(soup_.face_count);
        const auto is_equal = [&set](std::uint32_t a, std::uint32_t b) { return set.equal(a, b); };
        const auto is_twin = [&](std::uint32_t a, std::uint32_t b) {
            return set.equal(a, b) && faces_alike(area_of(soup_, a), area_of(soup_, b));
        };

        for (std::uint32_t i = 0; i < soup_.face_count; i++) {
            cancel_check();
            const std::uint64_t hash =
                XXH3_64bits(set.vertex.data() + set.begin[i], set.size(i) * sizeof set.vertex[0]);
            if (!is_finite(soup_, i))
                result_.non_finite_count++;
            else if (set.size(i) < 3 || area_of(soup_, i).is_flat)
                result_.degenerate_count++;
            else if (seen_facing.find_or_add(i, hash, is_twin) != i)
                result_.duplicate_count++;
            else if (seen.find_or_add(i, hash, is_equal) != i)
                result_.reversed_count++;
            else
                is_sound[i] = true;
        }
        return is_sound;
    }

    poly_mesh::VertexHandle handle_of(std::uint32_t vertex)
    {
        if (!handle_[vertex].is_valid()) handle_[vertex] = mesh_.new_vertex();
        return handle_[vertex];
    }

    void add(std::uint32_t face)
    {
        const std::uint32_t count = corner_count(face);
        std::vector<poly_mesh::VertexHandle> ring;

        cancel_check();
        for (std::uint32_t k = 0; k < count; k++)
            if (vertex(face, k) != vertex(face, (k + 1) % count))
                ring.push_back(handle_of(vertex(face, k)));
        std::vector<poly_mesh::VertexHandle> sorted = ring;
        std::sort(sorted.begin(), sorted.end());
        const bool is_simple = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
        if (is_simple && mesh_.add_face(ring).is_valid())
            face_.push_back(face);
        else
            result_.non_manifold_count++;
    }

    /* Halfedges begin at each corner whose edge has a length, in the order of the corners. */
    void look_around(std::uint32_t handle)
    {
        const std::uint32_t face = face_[handle], count = corner_count(face);
        auto halfedge = mesh_.halfedge_handle(poly_mesh::FaceHandle(static_cast<int>(handle)));
        std::uint32_t k = 0;

        cancel_check();
        while (vertex(face, k) == vertex(face, (k + 1) % count)) k++;
        while (mesh_.from_vertex_handle(halfedge) != handle_[vertex(face, k)])
            halfedge = mesh_.next_halfedge_handle(halfedge);
        for (; k < count; k++) {
            if (vertex(face, k) == vertex(face, (k + 1) % count)) continue;
            const auto beyond = mesh_.opposite_face_handle(halfedge);
            if (beyond.is_valid())
                result_.neighbours[soup_.first[face] + k] =
                    static_cast<std::int32_t>(face_[static_cast<std::size_t>(beyond.idx())]);
            halfedge = mesh_.next_halfedge_handle(halfedge);
        }
    }

    const soup_view &soup_;
    owned_connection &result_;
    std::vector<std::uint32_t> vertex_;           /* of each vertex the first at its place */
    std::vector<poly_mesh::VertexHandle> handle_; /* of each first vertex, once a face needs it */
    std::vector<std::uint32_t> face_;             /* of each face handle the face */
    poly_mesh mesh_;
};

} // namespace

extern "C" int mesh_connect(mesh_connection **out, std::uint32_t vertex_count,
                            const double (*position)[3], std::uint32_t face_count,
                            const std::uint32_t *first, const std::uint32_t *corner, char *message,
                            std::size_t message_size)
try {
    const soup_view soup = {vertex_count, position, face_count, first, corner};
    auto result = std::make_unique<owned_connection>();

    omerr().disable(); /* it would print one line for each non-manifold face */
    check(soup);
    if (face_count) result->neighbours.assign(first[face_count], -1);
    connector(soup, *result).run();
    result->neighbour = result->neighbours.data();
    *out = result.release();
    return 0;
} catch (...) {
    return failure_report("the neighbours of all facets", message, message_size);
}

extern "C" void mesh_connect_free(mesh_connection *connection)
{
    delete static_cast<owned_connection *>(connection);
}
