extern "C" {
#include "mesh_file.h"
}

#include "failure.hpp"
#include "file_text.hpp"
#include "mesh_soup.hpp"
#include "mesh_text.hpp"

#include <filesystem>
#include <memory>

namespace
{

/* The C record and the vectors that its pointers look into. */
struct owned_mesh : mesh_file {
    mesh_soup soup;
    std::string warning_text;
    std::vector<char *> object_names, part_names, material_names;
};

void read_format(mesh_soup &soup, const std::string &path, std::string &text)
{
    const std::string extension = std::filesystem::path(path).extension().string();

    if (!mesh_text_is(extension, ".stl")) mesh_text_unify(text);
    if (mesh_text_is(extension, ".obj"))
        mesh_obj_read(soup, path, text);
    else if (mesh_text_is(extension, ".ply"))
        mesh_ply_read(soup, path, text);
    else if (mesh_text_is(extension, ".stl"))
        mesh_stl_read(soup, path, text);
    else if (mesh_text_is(extension, ".off"))
        mesh_off_read(soup, path, text);
    else
        throw failure(path + ": extension \"" + extension +
                      "\", expected .gdb, .obj, .ply, .stl or .off");
}

/* Gives every face the same name where the format has none of this kind. */
void fill(std::vector<std::uint32_t> &index, mesh_names &names, std::size_t face_count,
          const std::string &name)
{
    if (index.empty()) index.assign(face_count, names.number_of(name));
}

std::uint32_t expose(std::vector<char *> &pointers, mesh_names &names)
{
    for (std::string &name : names.names) pointers.push_back(name.data());
    return static_cast<std::uint32_t>(pointers.size());
}

std::string joined(const std::vector<std::string> &texts, const char *between)
{
    std::string all;

    for (const std::string &text : texts) all.append(all.empty() ? "" : between).append(text);
    return all;
}

void expose(owned_mesh &mesh)
{
    mesh_soup &soup = mesh.soup;

    mesh.warning_text = joined(soup.warnings, "\n");
    mesh.warnings = mesh.warning_text.c_str();

    mesh.vertex_count = static_cast<std::uint32_t>(soup.position.size());
    mesh.position = reinterpret_cast<double(*)[3]>(soup.position.data());
    mesh.face_count = static_cast<std::uint32_t>(soup.face_count());
    mesh.first = soup.first.data();
    mesh.corner = soup.corner.data();
    mesh.object = soup.object.data();
    mesh.part = soup.part.data();
    mesh.material = soup.material.data();
    mesh.thickness_cm = soup.thickness_cm.empty() ? nullptr : soup.thickness_cm.data();
    mesh.object_count = expose(mesh.object_names, soup.objects);
    mesh.part_count = expose(mesh.part_names, soup.parts);
    mesh.material_count = expose(mesh.material_names, soup.materials);
    mesh.object_name = mesh.object_names.data();
    mesh.part_name = mesh.part_names.data();
    mesh.material_name = mesh.material_names.data();
}

} // namespace

extern "C" int mesh_file_read(mesh_file **out, const char *path, char *message, size_t message_size)
try {
    auto mesh = std::make_unique<owned_mesh>();
    mesh_soup &soup = mesh->soup;
    std::string text = file_text_load(path);

    read_format(soup, path, text);
    if (!soup.face_count())
        throw failure(std::string(path) + ": no faces" + (soup.warnings.empty() ? "" : ", but ") +
                      joined(soup.warnings, ", "));
    fill(soup.object, soup.objects, soup.face_count(), mesh_soup_stem(path));
    fill(soup.part, soup.parts, soup.face_count(), mesh_soup_part);
    fill(soup.material, soup.materials, soup.face_count(), mesh_soup_material);
    expose(*mesh);
    *out = mesh.release();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}

extern "C" void mesh_file_free(mesh_file *mesh)
{
    delete static_cast<owned_mesh *>(mesh);
}
