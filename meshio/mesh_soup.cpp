#include "mesh_soup.hpp"

#include <filesystem>

std::uint32_t mesh_names::number_of(const std::string &name)
{
    const auto [entry, is_new] = number_.emplace(name, static_cast<std::uint32_t>(names.size()));

    if (is_new) names.push_back(name);
    return entry->second;
}

std::string mesh_soup_stem(const std::string &path)
{
    return std::filesystem::path(path).stem().string();
}
