#include "tools/python/keywords.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tools/bindings/option_names.h"
#include "tools/nearest_name.h"
#include "tools/python/arrays.h"
#include "tools/usage_words.h"

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
    if (PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0 ||
        PySequence_Check(value.ptr()) == 0)
        return false;
    if (PyObject_Size(value.ptr()) >= 0) return true;
    // An array of no dimensions is a number.
    if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw py::error_already_set();
    PyErr_Clear();
    return false;
}

bool is_number(const py::handle& value) {
    return PyNumber_Check(value.ptr()) != 0 && !is_list(value) && !is_flag(value);
}

// The shortest text that is parsed to the same number.
std::string number_text(const py::handle& value, const std::string& keyword) {
    if (PyLong_Check(value.ptr()) != 0) return py::str(value);
    std::string text = py::repr(py::float_(number_of(value, keyword.c_str())));
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
}

// No option has a name with lone surrogates. They are escaped, for the message.
std::string keyword_text(const py::handle& key) {
    const auto text = py::reinterpret_steal<py::bytes>(
        PyUnicode_AsEncodedString(key.ptr(), "utf-8", "backslashreplace"));
    if (!text) throw py::error_already_set();
    return text;
}

// What options are given, and what the caller wrote for their values.
struct Words {
    std::vector<std::string> words;
    std::vector<std::pair<std::string, py::object>> written;

    void add(const std::string& keyword, const std::string& text, const py::handle& value) {
        // The next word would be taken for the value.
        if (text.empty())
            throw py::value_error(keyword + ": expected a value, not " +
                                  py::repr(value).cast<std::string>());
        words.push_back(option_name(keyword) + "=" + text);
        written.emplace_back(text, py::reinterpret_borrow<py::object>(value));
    }
    // The message with `(1, 2)` for `'1,2'`, and with `True` for `'on'`.
    std::string as_written(std::string message) const {
        for (const auto& [text, value] : written) {
            const std::string said = "not '" + text + "'";
            const std::size_t at = message.find(said);
            if (at != std::string::npos)
                message.replace(at, said.size(), "not " + py::repr(value).cast<std::string>());
        }
        return message;
    }
};

// Of a number or name, or of a list of these.
std::string value_text(const py::handle& value, const std::string& keyword) {
    if (PyUnicode_Check(value.ptr()) != 0) return utf8_of(value, keyword);
    if (is_number(value)) return number_text(value, keyword);
    if (!is_list(value))
        throw py::type_error(keyword + ": expected numbers or names, not " +
                             py::repr(value).cast<std::string>());
    std::string text;
    for (const py::handle& item : py::reinterpret_borrow<py::object>(value)) {
        if (!is_number(item) && PyUnicode_Check(item.ptr()) == 0)
            throw py::type_error(keyword + ": expected numbers or names, not " +
                                 py::repr(item).cast<std::string>());
        text += (text.empty() ? "" : ",") + value_text(item, keyword);
    }
    return text;
}

// Three or four numbers from 0 to 1, as of matplotlib, as #rrggbb or #rrggbbaa.
std::string color_text(const py::handle& value, const std::string& keyword) {
    std::string text = "#";
    for (const py::handle& item : py::reinterpret_borrow<py::object>(value)) {
        const double part = is_number(item) ? number_of(item, keyword.c_str()) : -1.0;
        if (!(part >= 0.0 && part <= 1.0))
            throw py::value_error(keyword + ": expected numbers from 0 to 1, not " +
                                  py::repr(value).cast<std::string>());
        std::array<char, 3> digits{};
        std::snprintf(digits.data(), digits.size(), "%02x",
                      static_cast<unsigned>(std::lround(255.0 * part)));
        text += digits.data();
    }
    return text;
}

// Of a list without lists in it.
std::string list_text(const CLI::Option& option, const py::handle& value,
                      const std::string& keyword) {
    const std::string type = option.get_type_name();
    const auto size = py::len(py::reinterpret_borrow<py::object>(value));
    if (type.starts_with("COLOR") && (size == 3 || size == 4)) return color_text(value, keyword);
    std::string text = value_text(value, keyword);
    if (type.starts_with("WxH") && size == 2) std::ranges::replace(text, ',', 'x');
    return text;
}

void add_words(Words& words, const CLI::Option& option, const std::string& keyword,
               const py::handle& value) {
    if (option.get_expected_max() == 0) {
        if (flag_of(value, keyword.c_str())) words.words.push_back(option_name(keyword));
    } else if (is_flag(value)) {
        words.add(keyword, flag_of(value, keyword.c_str()) ? "on" : "off", value);
    } else if (is_list(value)) {
        const auto items = py::reinterpret_borrow<py::object>(value);
        if (!std::any_of(items.begin(), items.end(), is_list))
            return words.add(keyword, list_text(option, value, keyword), value);
        if (option.get_expected_max() == 1 && py::len(items) > 1)
            throw py::value_error(keyword + ": expected one value, not " +
                                  py::repr(value).cast<std::string>());
        for (const py::handle& item : items) words.add(keyword, value_text(item, keyword), item);
    } else if (PyUnicode_Check(value.ptr()) != 0 || is_number(value)) {
        words.add(keyword, value_text(value, keyword), value);
    } else {
        throw py::type_error(keyword + ": expected a number, text, or a list of these, not " +
                             Py_TYPE(value.ptr())->tp_name);
    }
}

}  // namespace

std::string in_keywords(std::string message) {
    return tools::with_plain_names(std::move(message), '_');
}

void parse_keywords(CLI::App& app, const py::dict& keywords) {
    Words words;
    for (const auto& [key, value] : keywords) {
        const std::string keyword = keyword_text(key);
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
    std::ranges::reverse(words.words);  // CLI11 takes them from the end.
    try {
        app.parse(words.words);
    } catch (const CLI::ParseError& error) {
        throw py::value_error(words.as_written(in_keywords(tools::usage_words(error, app))));
    }
}

}  // namespace rimline::python
