# Writes the log of irace (irace.Rdata, of irace 3 or 4) as CSV tables into a folder:
#
#   Rscript irace_log.R irace.Rdata FOLDER
#
# `swarmsmith import irace.Rdata --into STORE` does this by itself; `swarmsmith import FOLDER --into
# STORE` reads the tables where there is no R. Needs no package, irace neither.

# The last line of the errors is the reason, which swarmsmith passes on.
options(error = function() quit(save = "no", status = 1))
fail <- function(...) {
  message(gsub("[[:space:]]+", " ", paste0(...)))
  quit(save = "no", status = 1)
}

words <- commandArgs(trailingOnly = TRUE)
if (length(words) != 2) fail("expected two words: LOG FOLDER")
loaded <- new.env()
names_loaded <- tryCatch(load(words[1], envir = loaded),
                         warning = function(e) fail("this is not an R file: ", conditionMessage(e)),
                         error = function(e) fail("this is not an R file: ", conditionMessage(e)))
if (!"iraceResults" %in% names_loaded) fail("this is not a log of irace: it has no iraceResults")
log <- loaded$iraceResults
folder <- words[2]

# Numbers keep all their digits; NA becomes an empty cell.
cells <- function(x, format = "%.17g") {
  # A text that begins as with the apostrophe against spreadsheets gets one, so that it comes back.
  text <- if (is.numeric(x)) sprintf(format, x) else
    sub("^('+[=+@\t\r\n-])", "'\\1", as.character(x), perl = TRUE)
  text[is.na(x)] <- ""
  text
}
# Parameters: as irace shows them, but whole numbers whole.
short <- function(x) {
  text <- cells(x, "%.15g")
  large <- if (is.numeric(x)) which(abs(x) >= 1e15 & x == floor(x)) else integer(0)
  text[large] <- sprintf("%.0f", x[large])
  text
}
write_table <- function(.file, ...) {
  columns <- data.frame(..., check.names = FALSE, stringsAsFactors = FALSE)
  utils::write.csv(columns, file.path(folder, .file), row.names = FALSE, quote = TRUE)
}
# A column of a matrix or of a data frame; NA where there is none.
column <- function(table, name) {
  if (name %in% colnames(table)) as.vector(if (is.matrix(table)) table[, name] else table[[name]])
  else rep(NA_real_, nrow(table))
}
first <- function(...) {
  for (value in list(...)) if (!is.null(value)) return(value)
  NULL
}

state <- log$state
scenario <- log$scenario
parameters <- first(scenario$parameters, log$parameters)

# From irace 4 on the log and the instances are in the state; irace 3 keeps them elsewhere.
runs <- first(state$experiment_log, log$experimentLog)
if (is.null(runs)) fail("the log has no list of runs; was it written by irace 3 or 4?")
pairs <- first(state$instances_log, state$.irace$instancesList, log$instancesList)
if (is.null(pairs)) fail("the log has no list of instances and seeds")
instance <- if ("instanceID" %in% colnames(pairs)) column(pairs, "instanceID") else
  column(pairs, "instance")

# Costs: beside each run where the log has them, else in the matrix of pairs and configurations.
pair <- column(runs, "instance")
configuration <- column(runs, "configuration")
cost <- column(runs, "cost")
if (all(is.na(cost))) {
  cost <- log$experiments[cbind(match(as.character(pair), rownames(log$experiments)),
                                match(as.character(configuration), colnames(log$experiments)))]
}

# Why it ended is a text; in irace 3.4 a list of whether it did, and the text.
completed <- first(state$completed, log$completed, "Incomplete")
if (is.list(completed)) completed <- if (isTRUE(completed$flag)) completed$msg else "Incomplete"
planned <- first(state$nbIterations, length(log$iterationElites))
restarts <- which(as.logical(log$softRestart))
keys <- c("irace_version", "completed", "seed", "max_experiments", "iterations",
          rep("soft_restart", length(restarts)))
write_table("log.csv", key = keys,
            value = c(as.character(first(log$irace_version, log$irace.version, "")),
                      as.character(completed), cells(first(scenario$seed, state$seed, NA_real_)),
                      cells(first(scenario$maxExperiments, 0)), cells(planned), restarts))

# Domains, conditions and what is forbidden are R's own texts.
source_of <- function(x) {
  text <- attr(x, "source")
  if (is.null(text) && (is.language(x) || is.expression(x)))
    text <- deparse(if (is.expression(x)) x[[1]] else x, width.cutoff = 500L)
  paste(text, collapse = " ")
}
of_parameters <- function(list, what) lapply(parameters$names, function(name) what(list[[name]]))
conditions <- of_parameters(parameters$conditions, function(x) if (is.null(x) || isTRUE(x)) "" else source_of(x))
transforms <- first(parameters$transform, lapply(parameters$.params, function(x) x$transform))
logs <- of_parameters(transforms, function(x) if (identical(as.character(x), "log")) "1" else "0")
write_table("parameters.csv", name = parameters$names,
            type = unname(unlist(parameters$types[parameters$names])),
            switch = cells(unname(unlist(parameters$switches[parameters$names]))),
            log = as.character(unlist(logs)), condition = cells(as.character(unlist(conditions))))
domains <- of_parameters(first(parameters$domains, parameters$domain), function(x) {
  if (!is.expression(x)) return(short(unlist(x)))
  vapply(x, function(bound) if (is.numeric(bound)) short(bound) else source_of(bound), "")
})
write_table("domains.csv", parameter = rep(parameters$names, lengths(domains)),
            value = as.character(unlist(domains)))

all <- log$allConfigurations
values <- lapply(parameters$names, function(name) short(column(all, name)))
names(values) <- parameters$names
write_table("configurations.csv", id = cells(all[[".ID."]]), parent = cells(all[[".PARENT."]]),
            as.data.frame(values, check.names = FALSE, stringsAsFactors = FALSE))

testing <- log$testing
tested <- if (is.null(testing)) matrix(numeric(0), 0, 0) else testing$experiments
seeds <- if (is.null(testing)) numeric(0) else as.vector(testing$seeds)
if (length(seeds) != nrow(tested)) seeds <- rep(NA_real_, nrow(tested))
write_table("pairs.csv", kind = c(rep("race", nrow(pairs)), rep("test", nrow(tested))),
            pair = c(seq_len(nrow(pairs)), seq_len(nrow(tested))),
            instance = cells(c(instance, seq_len(nrow(tested)))),
            seed = cells(c(column(pairs, "seed"), seeds)))
write_table("runs.csv", iteration = cells(column(runs, "iteration")), pair = cells(pair),
            configuration = cells(configuration), cost = cells(cost),
            time = cells(column(runs, "time")), bound = cells(column(runs, "bound")))

# Options that are one truth, number or text.
literal <- function(x) {
  if (is.character(x)) encodeString(x, quote = "\"") else if (is.logical(x)) as.character(x) else cells(x, "%.15g")
}
is_plain <- function(x) is.atomic(x) && length(x) == 1 && !is.na(x) && !(is.numeric(x) && !is.finite(x))
apart <- c("instances", "testInstances", "seed", "maxExperiments", "digits")
plain <- Filter(is_plain, scenario[setdiff(names(scenario), apart)])
places <- unlist(lapply(parameters$.params, function(x) x$digits))
digits <- first(if (length(places)) max(places), scenario$digits, 4)
forbidden <- first(parameters$forbidden, scenario$forbiddenExps, state$forbiddenExps)
clauses <- vapply(as.list(forbidden), source_of, "")
write_table("scenario.csv",
            option = c(names(plain), "digits", rep("forbidden", length(clauses))),
            value = cells(c(vapply(plain, literal, "", USE.NAMES = FALSE), literal(digits),
                            vapply(clauses, literal, "", USE.NAMES = FALSE))))
named <- function(x) if (is.atomic(x) && !all(is.na(x))) as.character(x) else character(0)
trained <- named(scenario$instances)
test_names <- named(scenario$testInstances)
write_table("instances.csv", kind = c(rep("race", length(trained)), rep("test", length(test_names))),
            instance = c(seq_along(trained), seq_along(test_names)), name = cells(c(trained, test_names)))

elites <- log$allElites
lengths <- vapply(elites, length, 0L)
write_table("elites.csv", iteration = rep(seq_along(elites), lengths),
            rank = unlist(lapply(lengths, seq_len)), configuration = cells(unlist(elites)))
write_table("tests.csv",
            pair = rep(seq_len(nrow(tested)), times = ncol(tested)),
            configuration = rep(colnames(tested), each = nrow(tested)),
            cost = cells(as.vector(tested)))
