#include "tools/python/keywords.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "tools/nearest_name.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

std::string option_name(std::string keyword) {
    std::ranges::replace(keyword, '_', '-');
    return "--" + keyword;
}

std::string keyword_name(std::string option) {
    option.erase(0, 2);
    std::ranges::replace(option, '-', '_');
    return option;
}

bool is_list(const py::handle& value) {
    return PyUnicode_Check(value.ptr()) == 0 && PyDict_Check(value.ptr()) == 0 &&
           py::hasattr(value, "__len__") && py::hasattr(value, "__getitem__");
}

bool is_number(const py::handle& value) {
    return PyUnicode_Check(value.ptr()) == 0 && PyNumber_Check(value.ptr()) != 0 && !is_list(value);
}

// The shortest text that is parsed to the same number.
std::string number_text(const py::handle& value) {
    const auto fail = [] { throw py::error_already_set(); };
    if (PyLong_Check(value.ptr()) != 0) return py::str(value);
    const double number = PyFloat_AsDouble(value.ptr());
    if (number == -1.0 && PyErr_Occurred() != nullptr) fail();
    std::string text = py::repr(py::float_(number));
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
}

std::string joined(const py::handle& values, const std::string& keyword) {
    std::string text;
    for (const py::handle& value : py::reinterpret_borrow<py::object>(values)) {
        if (!text.empty()) text += ',';
        if (is_number(value))
            text += number_text(value);
        else if (PyUnicode_Check(value.ptr()) != 0)
            text += value.cast<std::string>();
        else
            throw py::type_error(keyword + ": expected numbers or names");
    }
    return text;
}

void add_words(std::vector<std::string>& words, const CLI::Option& option,
               const std::string& keyword, const py::handle& value) {
    const std::string name = option_name(keyword);
    const bool is_flag = option.get_expected_max() == 0;
    if (is_flag || PyBool_Check(value.ptr()) != 0) {
        if (PyBool_Check(value.ptr()) == 0)
            throw py::type_error(keyword + ": expected True or False");
        const bool is_on = value.cast<bool>();
        if (!is_flag)
            words.push_back(name + (is_on ? "=on" : "=off"));
        else if (is_on)
            words.push_back(name);
    } else if (PyUnicode_Check(value.ptr()) != 0) {
        words.push_back(name + "=" + value.cast<std::string>());
    } else if (is_list(value)) {
        const auto items = py::reinterpret_borrow<py::object>(value);
        const bool is_nested = py::len(items) > 0 && is_list(items[py::int_(0)]);
        if (!is_nested)
            words.push_back(name + "=" + joined(items, keyword));
        else
            for (const py::handle& item : items)
                words.push_back(name + "=" + joined(item, keyword));
    } else if (is_number(value)) {
        words.push_back(name + "=" + number_text(value));
    } else {
        throw py::type_error(keyword + ": expected a number, text, or a list of these");
    }
}

}  // namespace

std::string in_keywords(std::string message) {
    for (std::size_t at = 0; (at = message.find("--", at)) != std::string::npos;) {
        const std::size_t begin = at + 2;
        std::size_t end = begin;
        while (end < message.size() && (std::islower(message[end]) != 0 || message[end] == '-'))
            ++end;
        const std::string keyword = keyword_name(message.substr(at, end - at));
        message.replace(at, end - at, keyword);
        at += std::max<std::size_t>(keyword.size(), 1);
    }
    return message;
}

void parse_keywords(CLI::App& app, const py::dict& keywords) {
    std::vector<std::string> words;
    for (const auto& [key, value] : keywords) {
        const auto keyword = key.cast<std::string>();
        const CLI::Option* option = app.get_option_no_throw(option_name(keyword));
        if (option == nullptr || keyword == "help") {
            std::vector<std::string> known;
            for (const CLI::Option* other : app.get_options())
                if (!other->get_lnames().empty())
                    known.push_back(keyword_name("--" + other->get_lnames().front()));
            throw py::type_error("unexpected keyword argument '" + keyword + "'" +
                                 tools::did_you_mean(keyword, known));
        }
        if (!value.is_none()) add_words(words, *option, keyword, value);
    }
    std::ranges::reverse(words);  // CLI11 takes them from the end.
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        throw py::value_error(in_keywords(error.what()));
    }
}

}  // namespace rimline::python
