# Writes the tables of a run as the log of irace (irace.Rdata, as irace 3.5 and 4 keep it):
#
#   Rscript irace_rdata.R FOLDER irace.Rdata
#
# `swarmsmith export STORE --format rdata -o irace.Rdata` does this by itself; with `-o FOLDER/` it
# writes the tables, where there is no R. Needs no package, irace neither. irace_log.R is the reverse.

# The last line of the errors is the reason, which swarmsmith passes on.
options(error = function() quit(save = "no", status = 1))
fail <- function(...) {
  message(gsub("[[:space:]]+", " ", paste0(...)))
  quit(save = "no", status = 1)
}

words <- commandArgs(trailingOnly = TRUE)
if (length(words) != 2) fail("expected two words: FOLDER LOG")
folder <- words[1]

# Texts as they are, but for the apostrophe that keeps a spreadsheet from calculating.
read_table <- function(name, optional = character(0)) {
  file <- file.path(folder, name)
  if (!file.exists(file)) {
    if (!length(optional)) fail("the folder has no table ", name)
    return(as.data.frame(sapply(optional, function(column) character(0), simplify = FALSE)))
  }
  table <- utils::read.csv(file, colClasses = "character", na.strings = character(0), fill = FALSE,
                           check.names = FALSE, encoding = "UTF-8")
  table[] <- lapply(table, function(x) sub("^'(?='*[=+@\t\r\n-])", "", x, perl = TRUE))
  table
}
# An empty cell is NA.
number <- function(x) {
  x[x == ""] <- NA
  suppressWarnings(as.numeric(x))
}
whole <- function(x) {
  x <- number(x)
  if (all(is.na(x) | abs(x) <= .Machine$integer.max)) as.integer(x) else x
}
language <- function(text) parse(text = text, keep.source = FALSE)

head_table <- read_table("log.csv")
head_value <- function(key) head_table$value[head_table$key == key]
parameter_table <- read_table("parameters.csv")
domain_table <- read_table("domains.csv", c("parameter", "value"))
configuration_table <- read_table("configurations.csv")
pair_table <- read_table("pairs.csv")
run_table <- read_table("runs.csv")
elite_table <- read_table("elites.csv")
test_table <- read_table("tests.csv")
instance_table <- read_table("instances.csv", c("kind", "instance", "name"))
option_table <- read_table("scenario.csv", c("option", "value"))

# Options: R's own words for a truth, a number or a text; nothing else is evaluated.
constant <- function(text) {
  value <- language(text)
  value <- if (length(value) == 1) value[[1]]
  if (is.call(value) && length(value) == 2 && identical(value[[1]], quote(`-`)) &&
      is.numeric(value[[2]])) value <- -value[[2]]
  if (!is.character(value) && !is.numeric(value) && !is.logical(value))
    fail("scenario.csv: no truth, number or text: ", text)
  value
}
forbidden <- vapply(option_table$value[option_table$option == "forbidden"], constant, "")
option_table <- option_table[option_table$option != "forbidden", , drop = FALSE]
scenario <- lapply(option_table$value, constant)
names(scenario) <- option_table$option
defaults <- list(testNbElites = 1, testIterationElites = FALSE, elitist = TRUE, maxTime = 0,
                 deterministic = FALSE, digits = 4, trainInstancesDir = "", testType = "F-test",
                 targetRunner = "", debugLevel = 0, capping = FALSE, postselection = FALSE,
                 softRestart = TRUE, confidence = 0.95, firstTest = 5, eachTest = 1)
scenario <- c(scenario, defaults[setdiff(names(defaults), names(scenario))])

# Parameters. Where the tables have no domain, what was tried stands in its place.
names_of <- parameter_table$name
types <- setNames(parameter_table$type, names_of)
is_number <- types %in% c("i", "r")
columns <- lapply(seq_along(names_of), function(i) {
  column <- configuration_table[[i + 2]]
  if (is_number[i]) return(number(column))
  column[column == ""] <- NA
  column
})
names(columns) <- names_of
conditions <- lapply(parameter_table$condition, function(text) if (text == "") TRUE else language(text))
if (!length(conditions)) conditions <- rep(list(TRUE), length(names_of))
names(conditions) <- names_of
is_log <- if (is.null(parameter_table$log)) rep(FALSE, length(names_of)) else parameter_table$log == "1"
domains <- lapply(seq_along(names_of), function(i) {
  values <- domain_table$value[domain_table$parameter == names_of[i]]
  if (!length(values)) {
    tried <- columns[[i]][!is.na(columns[[i]])]
    return(if (!is_number[i]) sort(unique(tried)) else if (length(tried)) range(tried) else c(0, 1))
  }
  if (!is_number[i]) return(values)
  numbers <- number(values)
  if (!anyNA(numbers)) return(numbers)
  as.expression(lapply(seq_along(values), function(k)
    if (is.na(numbers[k])) language(values[k])[[1]] else numbers[k]))
})
names(domains) <- names_of
is_dependent <- vapply(domains, is.expression, NA)
is_fixed <- !is_number & lengths(domains) == 1
names(is_fixed) <- names_of
transforms <- lapply(seq_along(names_of), function(i) {
  if (!is_log[i]) return("")
  upper <- domains[[i]][2]
  structure("log", lower = log(domains[[i]][1]), upper = log(if (types[i] == "i") upper + 1 else upper))
})
names(transforms) <- names_of
depends <- Map(function(domain, condition) union(all.vars(domain), all.vars(condition)), domains,
               conditions)
level <- function(name) {
  others <- intersect(depends[[name]], names_of)
  if (!length(others)) 1 else 1 + max(vapply(others, level, 0))
}
hierarchy <- vapply(names_of, level, 0)
conditions <- conditions[order(hierarchy)]
switches <- setNames(parameter_table$switch, names_of)
compiled <- function(text) {
  clause <- parse(text = text, keep.source = FALSE)[[1]]
  code <- compiler::compile(substitute(is.na(x) | !(x), list(x = clause)),
                            options = list(suppressUndefined = TRUE))
  attr(code, "source") <- text
  code
}
forbidden_code <- lapply(forbidden, compiled)
if (!length(forbidden_code)) forbidden_code <- NULL

# The object of irace 3.5, and that of irace 4: it is one of the package R6, which is an environment.
parameters <- list(names = names_of, types = types, switches = switches, domain = domains,
                   conditions = conditions, isFixed = is_fixed, transform = transforms,
                   isDependent = is_dependent, depends = depends, hierarchy = hierarchy,
                   nbParameters = length(names_of), nbFixed = sum(is_fixed),
                   nbVariable = sum(!is_fixed))
space <- new.env(parent = emptyenv())
space$names <- names_of
space$types <- types
space$switches <- switches
space$domains <- domains
for (name in names_of[types == "i" & !is_dependent])
  if (all(abs(domains[[name]]) <= .Machine$integer.max)) space$domains[[name]] <- as.integer(domains[[name]])
space$conditions <- conditions
space$depends <- depends
space$hierarchy <- setNames(as.integer(hierarchy), names_of)
space$isFixed <- is_fixed
space$names_fixed <- names_of[is_fixed]
space$names_variable <- names_of[!is_fixed]
space$names_numeric <- names_of[is_number]
space$nbParameters <- length(names_of)
space$nbFixed <- sum(is_fixed)
space$nbVariable <- sum(!is_fixed)
space$forbidden <- forbidden_code
space$.params <- lapply(names_of, function(name) {
  type <- types[[name]]
  parameter <- list(name = name, type = type, domain = space$domains[[name]],
                    label = switches[[name]], is_dependent = is_dependent[[name]],
                    isFixed = is_fixed[[name]], transform = transforms[[name]],
                    condition = conditions[[name]])
  if (type == "r") parameter$digits <- as.integer(scenario$digits)
  kind <- c(i = "ParamInt", r = "ParamReal", c = "ParamCat", o = "ParamOrd")[[type]]
  structure(parameter, class = c(kind, "Parameter", "list"))
})
names(space$.params) <- names_of
inside <- new.env(parent = baseenv())
inside$self <- space
space$get <- function(x) if (missing(x)) self$.params else self$.params[[x]]
space$get_ordered <- function() self$.params[names(self$conditions)]
# The text of a parameter file.
space$as_character <- function() {
  bounds <- function(x) {
    if (is.expression(x)) x <- vapply(x, function(one)
      if (is.numeric(one)) format(one, digits = 15) else paste0("\"", deparse(one, width.cutoff = 500L), "\""), "")
    paste0("(", paste0(x, collapse = ","), ")")
  }
  lines <- vapply(self$.params, function(one) {
    condition <- if (isTRUE(one$condition)) "" else paste(" |", paste(as.character(as.expression(one$condition)), collapse = " "))
    type <- if (identical(as.character(one$transform), "log")) paste0(one$type, ",log") else one$type
    paste0(one$name, " \"", one$label, "\" ", type, " ", bounds(one$domain), condition)
  }, "")
  if (length(self$forbidden))
    lines <- c(lines, "", "[forbidden]", vapply(self$forbidden, attr, "", "source"))
  places <- unlist(lapply(self$.params, function(one) one$digits))
  if (length(places)) lines <- c(lines, "", "[global]", paste("digits =", max(places)))
  paste0(paste(lines, collapse = "\n"), "\n")
}
# The rows of a data frame of configurations: each is one that must not come again.
space$forbid_configurations <- function(x) {
  for (i in seq_len(NROW(x))) {
    values <- as.list(x[i, self$names, drop = FALSE])
    values <- values[!is.na(values)]
    clauses <- paste0("(", names(values), " == ", vapply(values, deparse, ""), ")")
    self$forbidden <- c(self$forbidden, list(compiled(paste(clauses, collapse = " & "))))
  }
  invisible(self)
}
inside$compiled <- compiled
for (method in c("get", "get_ordered", "as_character", "forbid_configurations")) environment(space[[method]]) <- inside
environment(inside$compiled) <- inside
class(space) <- c("ParameterSpace", "R6")

# Configurations, pairs and runs. Ids are whole numbers: 100000 is "100000", not "1e+05".
ids <- whole(configuration_table$id)
all_configurations <- data.frame(.ID. = ids, columns, .PARENT. = whole(configuration_table$parent),
                                 check.names = FALSE, stringsAsFactors = FALSE)
names(all_configurations) <- c(".ID.", names_of, ".PARENT.")
row.names(all_configurations) <- as.character(ids)
# As package data.table makes it, which irace 4 uses, and reads it from a file: with a pointer to
# nothing. A data frame where that is not loaded.
nothing <- unserialize(as.raw(c(0x58, 0x0a, 0, 0, 0, 2, 0, 4, 2, 2, 0, 2, 3, 0,
                                0, 0, 0, 0x16, 0, 0, 0, 0xfe, 0, 0, 0, 0xfe)))
data_table <- function(...) {
  columns <- list(...)
  structure(columns, row.names = .set_row_names(length(columns[[1]])),
            class = c("data.table", "data.frame"), .internal.selfref = nothing)
}
pairs <- pair_table[pair_table$kind == "race", , drop = FALSE]
numbers <- whole(pairs$pair)
pair_count <- max(0L, numbers)
instances_log <- data_table(instanceID = whole(pairs$instance)[match(seq_len(pair_count), numbers)],
                            seed = whole(pairs$seed)[match(seq_len(pair_count), numbers)])
runs <- data_table(iteration = whole(run_table$iteration), instance = whole(run_table$pair),
                   configuration = whole(run_table$configuration), cost = number(run_table$cost),
                   time = number(run_table$time), bound = number(run_table$bound))
rows <- max(0L, runs$instance)
experiments <- matrix(NA_real_, rows, length(ids), dimnames = list(as.character(seq_len(rows)), as.character(ids)))
experiments[cbind(runs$instance, match(runs$configuration, ids))] <- runs$cost
experiment_log <- cbind(iteration = runs$iteration, instance = runs$instance,
                        configuration = runs$configuration, time = runs$time, bound = runs$bound)
rejected <- sort(unique(runs$configuration[is.infinite(runs$cost)]))
if (!length(rejected)) rejected <- NULL

iterations <- max(0L, whole(elite_table$iteration))
elites <- lapply(seq_len(iterations), function(i) {
  of <- elite_table[whole(elite_table$iteration) == i, , drop = FALSE]
  whole(of$configuration)[order(whole(of$rank))]
})
first_elites <- vapply(elites, function(x) x[1], 0L)
restarts <- whole(head_value("soft_restart"))
soft_restart <- seq_len(max(iterations, restarts)) %in% restarts

tests <- pair_table[pair_table$kind == "test", , drop = FALSE]
testing <- NULL
if (nrow(test_table)) {
  test_rows <- whole(tests$pair)
  tested <- unique(whole(test_table$configuration))
  names_of_tests <- paste0(test_rows, "t")
  testing <- list(
    experiments = matrix(NA_real_, length(test_rows), length(tested),
                         dimnames = list(names_of_tests, as.character(tested))),
    seeds = setNames(whole(tests$seed), names_of_tests))
  testing$experiments[cbind(match(whole(test_table$pair), test_rows),
                            match(whole(test_table$configuration), tested))] <- number(test_table$cost)
}

# An instance without a name is called by its number.
instance_names <- function(kind, count) {
  of <- instance_table[instance_table$kind == kind, , drop = FALSE]
  numbers <- whole(of$instance)
  names <- as.character(seq_len(max(0L, numbers, count, na.rm = TRUE)))
  names[numbers] <- of$name
  names
}
scenario$instances <- instance_names("race", instances_log$instanceID)
test_instances <- instance_names("test", whole(tests$pair))
scenario$testInstances <- if (length(test_instances)) test_instances
scenario$seed <- whole(head_value("seed"))
scenario$maxExperiments <- whole(head_value("max_experiments"))
scenario$forbiddenExps <- forbidden_code
scenario$parameters <- space

version <- head_value("irace_version")
# irace 4 refuses options that it does not know: digits are those of each parameter, and what is forbidden is the space's.
number_of <- numeric_version(sub("^([0-9]+(\\.[0-9]+)*).*", "\\1", version), strict = FALSE)
if (!isTRUE(number_of < "3.9")) {
  scenario$digits <- NULL
  scenario$forbiddenExps <- NULL
  if (isFALSE(scenario$cappingAfterFirstTest)) scenario$cappingAfterFirstTest <- NULL
}
used <- length(runs$instance)
last_elites <- if (iterations) elites[[iterations]] else integer(0)
inner <- new.env(parent = emptyenv())
inner$instancesList <- data.frame(instance = instances_log$instanceID, seed = instances_log$seed)
state <- list(.irace = inner,
              eliteConfigurations = all_configurations[match(last_elites, ids), , drop = FALSE],
              experimentsUsedSoFar = used, indexIteration = iterations + 1L,
              nbIterations = whole(head_value("iterations")),
              remainingBudget = max(0, scenario$maxExperiments - used),
              timeUsed = sum(runs$time, 0, na.rm = TRUE), seed = scenario$seed,
              completed = head_value("completed"), experiment_log = runs,
              instances_log = instances_log)
state$elite_configurations <- state$eliteConfigurations
state$rejectedIDs <- state$rejected_ids <- rejected
iraceResults <- list(scenario = scenario, irace_version = version, irace.version = version,
                     parameters = parameters, allElites = elites, experiments = experiments,
                     experimentLog = experiment_log, state = state,
                     allConfigurations = all_configurations, softRestart = soft_restart,
                     iterationElites = first_elites)
if (!is.null(testing)) iraceResults$testing <- testing
save(iraceResults, file = words[2], version = 3)
