first_value = 1;
second_value = first_value + 1;
module included_module() { echo("included", first_value, second_value); }
