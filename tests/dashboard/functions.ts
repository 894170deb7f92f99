// What functions_test.py calls in a browser.
export { pose_at, robot_at, value_at } from "../../web/src/arena";
export { csv, duration, id_of, number, parse_csv, percent, shell_word, whole } from "../../web/src/format";
export { grown } from "../../web/src/get";
export { axis_of, chosen_by, part_on, text_at, varies } from "../../web/src/parallel";
export { href, match, parse_route } from "../../web/src/route";
